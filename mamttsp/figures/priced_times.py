"""What time prices do: relaxed times, the tilt of two costs, and tangents of a distance."""

import numpy as np

from ..tours import Visit
from .canvas import canvas
from .lettering import READ, write_beside
from .plan import draw_targets, window_numbers
from .style import COLOURS, DEPOT, LINES, MARKERS, once


def relaxed_view(instance, graph, route, arrive, leave, ax=None):
    """Draw a route whose visits may be left at another time than they are made, from above, and return the axes.

    route: (K,) segments in order; arrive, leave: (K,) times of each visit in s. Legs are arrows from where a visit is
    left to where the next one is made; a bar along the segment joins the two places of one visit. Beside each visit are
    its target's number and both times, arrival → departure.
    """
    ax = canvas(ax, (8, 6))
    lines = draw_targets(ax, instance)
    made, left = (np.array([graph.position(i, t) for i, t in zip(route, times)]) for times in (arrive, leave))
    legs = list(zip(np.vstack([instance.depot, left]), np.vstack([made, instance.depot])))
    for p, q in legs:
        arrow = {"arrowstyle": "-|>", "color": COLOURS[0], "linewidth": 1.5, "shrinkA": 0, "shrinkB": 0}
        ax.annotate("", q, p, arrowprops=arrow, zorder=4)
    ax.plot([], [], color=COLOURS[0], linewidth=1.5, label="leg")
    for k, (p, q) in enumerate(zip(made, left)):
        bar = {"color": COLOURS[1], "linewidth": 3.0, "solid_capstyle": "butt", "zorder": 5}
        ax.plot(*np.c_[p, q], **bar, **once(k, "jump of a visit"))
    ax.plot(*instance.depot, **DEPOT, label="depot")
    ax.set(xlabel="x (units)", ylabel="y (units)", aspect="equal")
    ax.apply_aspect()
    visits = [Visit(int(graph.tau[i]), float(t), tuple(p)) for i, t, p in zip(route, arrive, made)]
    words = [(f"{v.target}: {v.time:.0f} → {t:.0f} s", v.position, {}) for v, t in zip(visits, leave)]
    lines += [(np.array(line), READ) for line in [*legs, *zip(made, left)]]
    write_beside(ax, [*words, *window_numbers(instance, visits)], lines)
    ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0, frameon=False)
    return ax


def tilt_view(times, so_far, to_go, best, price=0.0, ax=None):
    """Draw the cost so far and to go of a visit against its time, tilted by a price, and return the axes.

    times: (N,) s; so_far, to_go: (N,) lengths in units, infinite where not flyable; best: the index of the visit's best
    time; price: mu in units/s. All curves are shown relative to their values there; marks are their lowest points. Each
    curve is thinner than the one below it, so that none is hidden where they coincide.
    """
    ax = canvas(ax, (5, 4))
    tilt = price * (times - times[best])
    curves = {"so far": so_far - so_far[best] + tilt, "to go": to_go - to_go[best] - tilt}
    curves["sum"] = curves["so far"] + curves["to go"]
    for k, (name, values) in enumerate(curves.items()):
        style = {"color": (COLOURS[0], COLOURS[1], "black")[k], "alpha": (0.45, 1.0, 1.0)[k]}
        ax.plot(times, values, **style, linestyle=LINES[k], linewidth=(6.0, 2.5, 1.2)[k], label=name)
        lowest = np.nanargmin(np.where(np.isfinite(values), values, np.nan))
        ax.plot(times[lowest], values[lowest], MARKERS[k], **style, markersize=(13, 8, 4)[k])
    ax.axhline(0.0, color="0.8", linewidth=0.8, zorder=0)
    ax.set(xlabel="time of the visit (s)", ylabel="units more than at the best time")
    ax.set_title(f"price {price:.2f} units/s")
    ax.legend(frameon=False)
    return ax


def tangents_view(pieces, arcs, graph, q, i, ax=None):
    """Draw the distance from the middle of piece q to segment i against the time on it, with the minorants of the arcs
    from q to its pieces, and return the axes."""
    ax = canvas(ax, (5, 4))
    half = (pieces.b[q] - pieces.a[q]) / 2
    times = np.linspace(graph.t_lo[i], graph.t_hi[i], 200)
    places = graph.p_lo[i] + (times - graph.t_lo[i])[:, None] * graph.v[i]
    distance = np.linalg.norm(places - pieces.p[q] - half * pieces.v[q], axis=1)
    ax.plot(times, distance, color="black", label="distance")
    drawn = (arcs.tail == q) & (pieces.segment[arcs.head] == i)
    for k, (r, (c, slope_q, slope_r)) in enumerate(zip(arcs.head[drawn], arcs.leg[drawn])):
        values = c + slope_q * half + slope_r * np.array([0.0, pieces.b[r] - pieces.a[r]])
        ax.plot([pieces.a[r], pieces.b[r]], values, "|--", color=COLOURS[0], **once(k, "minorant on a piece"))
    ax.set(xlabel="time on the segment (s)", ylabel="distance (units)")
    ax.legend(frameon=False)
    return ax
