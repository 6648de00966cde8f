"""The hole in the proof of validity: a cycle of no length and no duration, and how near targets must pass for it."""

import numpy as np
from matplotlib.text import OffsetFrom

from ..tours import as_tours
from .canvas import canvas
from .plan import target_parts
from .style import COLOURS, DEPOT, LINES, MARKERS, PATH, WINDOW, method_style, once, route_name


def cycle_view(instance, tours=(), cycles=(), ax=None):
    """Draw x against time, for targets, tours, and cycles that miss the depot, and return the axes.

    tours: a Solution, or a sequence of Tour; cycles: sequences of Visit, each drawn as a loop around the
    place and time of its first visit.
    """
    ax = canvas(ax, (8, 5))
    for target, path, in_windows in target_parts(instance):
        ax.plot(*path[:, [0, 2]].T, **PATH, **once(target, "target's path"))
        ax.annotate(str(target), path[0, [0, 2]], xytext=(0, -9), textcoords="offset points", ha="center", va="top")
        for w, window in enumerate(in_windows):
            ax.plot(*window[:, [0, 2]].T, **WINDOW, **once(target + w, "time window"))
    for k, tour in enumerate(as_tours(tours)):
        stops = [(instance.depot[0], 0.0), *((visit.position[0], visit.time) for visit in tour.visits)]
        stops.append((instance.depot[0], tour.return_time))
        style = {"color": COLOURS[k % len(COLOURS)], "linestyle": LINES[k % len(LINES)], "marker": MARKERS[0]}
        ax.plot(*np.transpose(stops), **style, zorder=4, label=f"tour {k}")
    for k, cycle in enumerate(cycles):
        _draw_loop(ax, cycle[0].position[0], cycle[0].time, once(k, "cycle that nobody flies"))
    ax.plot(instance.depot[0], 0.0, **DEPOT, label="depot")
    ax.set(xlabel="x (units)", ylabel="time (s)", ylim=(-0.08 * instance.horizon, 1.02 * instance.horizon))
    ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0, frameon=False)
    return ax


def _draw_loop(ax, x, t, label):
    """Draw two bent arrows around a point, of the same size whatever the scales of the axes."""
    ax.plot(x, t, "o", color=COLOURS[1], zorder=5, **label)
    around = OffsetFrom(ax.transData, (x, t), unit="points")
    arrow = {"arrowstyle": "-|>", "color": COLOURS[1], "linewidth": 2.0, "connectionstyle": "arc3,rad=0.9"}
    for side in (14.0, -14.0):
        ax.annotate("", (-side, 0.0), (side, 0.0), xycoords=around, textcoords=around, arrowprops=arrow, zorder=6)


def leak_view(misses, claims, truth, limit, ax=None):
    """Draw the lengths that models claim against how far two targets miss each other, and return the axes.

    misses: units, none of them 0; claims: {formulation: lengths}; truth: the true optima; limit: the miss, in units,
    below which the baseline is expected to be wrong, drawn as an upright line.
    """
    ax = canvas(ax, (7, 4))
    ax.plot(misses, truth, color="0.75", linewidth=6.0, label="true optimum")
    for method, lengths in claims.items():
        ax.plot(misses, lengths, **method_style(method), label=f"claimed by {route_name(method)}")
    ax.axvline(limit, color="black", linestyle=":", linewidth=1.0, label="$R$ times the root of the tolerance")
    ax.set(xscale="log", xlabel="miss distance of the two targets (units)", ylabel="length (units)")
    ax.set_ylim(bottom=0)
    ax.legend(loc="center left", bbox_to_anchor=(1.02, 0.5), borderaxespad=0.0, frameon=False)
    return ax
