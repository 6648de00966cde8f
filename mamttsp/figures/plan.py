"""Tours from above, as in the paper's Fig. 1, and in space-time."""

import itertools

import numpy as np
from matplotlib import rcParams

from ..instance import Instance
from ..tours import agents_of, as_tours
from ..validation import counted, of_type
from .canvas import canvas
from .depots import depots
from .lettering import PATHS, READ, WINDOWS, write_beside
from .style import COLOURS, LABEL, LINES, MARKERS, PATH, WINDOW, in_print, once


def plan_view(instance, tours=(), ax=None, unit="units"):
    """Draw an instance from above, with tours if there are any, and return the axes.

    tours: a Solution, or a sequence of Tour. Target paths are grey, from a dot at their start; the parts inside time
    windows are thick and yellow, with the target's number beside each. Each tour has a colour, line style and marker of
    its own, and an arrowhead on each leg; a visit has its target's number and its time beside it, the legend the time
    of the return. Targets and tours have the numbers of files and code, from 0. The legend counts idle agents.
    unit: of lengths, as the axes name it, such as "km". InputError: not an Instance, no tours, or no axes.

    >>> from mamttsp import generate
    >>> from mamttsp.figures import plan_view
    >>> ax = plan_view(generate(n_targets=3, total_window=20, seed=1))
    >>> ax.get_xlabel()
    'x (units)'
    """
    of_type("instance", instance, Instance)
    tours = as_tours(tours)
    ax = canvas(ax, (8, 6))
    lines, flown = draw_targets(ax, instance), list(_flown(instance, tours))
    for stops, style, label in flown:
        ax.plot(*stops[:, :2].T, **style, label=label)
        lines.append((stops, READ))
    for place, style, label in depots(instance):
        ax.plot(*place, **in_print(style), label=label)
    _count_idle(ax, instance, tours)
    ax.set(xlabel=f"x ({unit})", ylabel=f"y ({unit})", aspect="equal")
    ax.apply_aspect()  # now lengths on paper are known, but for the room that a legend takes
    for stops, style, _ in flown:
        point_the_way(ax, stops, style["color"])
    write_beside(ax, [*_visited(tours), *window_numbers(instance, _visits(tours))], lines)
    ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0, frameon=False)
    return ax


def space_time_view(instance, tours=(), ax=None, unit="units"):
    """Draw an instance in space and time, time upwards, with tours if there are any, and return the (3D) axes.

    A target's path is a line that rises as time goes on; a visit is where an agent's line touches it, inside a window.
    tours: a Solution, or a sequence of Tour. Each is drawn at constant speed on each leg; dotted upright lines are
    depots and ends. Colours, numbers and unit as in plan_view. InputError: not an Instance, no tours, or no such axes.

    >>> from mamttsp import generate
    >>> from mamttsp.figures import space_time_view
    >>> space_time_view(generate(n_targets=3, total_window=20, seed=1)).get_zlabel()
    'time (s)'
    """
    of_type("instance", instance, Instance)
    tours = as_tours(tours)
    ax = canvas(ax, (8, 7), projection="3d", computed_zorder=False)
    for target, path, in_windows in target_parts(instance):
        ax.plot(*path.T, **PATH, **once(target, "target's path"))
        for w, window in enumerate(in_windows):
            ax.plot(*window.T, **WINDOW | {"linewidth": 4.0}, **once(target + w, "time window"))
    for stops, style, label in _flown(instance, tours):
        ax.plot(*stops.T, **style, label=label)
    for visit in _visits(tours):
        ax.text(*visit.position, visit.time + 0.04 * instance.horizon, str(visit.target), **LABEL)
    for number, (x, y, t), style in window_numbers(instance, _visits(tours)):
        ax.text(x, y, t, f" {number}", **LABEL | {"ha": "left"} | style)
    for place, style, label in depots(instance):
        ax.plot(*np.tile(place, (2, 1)).T, [0, instance.horizon], color="black", linestyle=":", linewidth=1.0)
        ax.plot(*place, 0.0, **style, label=label)
    _count_idle(ax, instance, tours)
    ax.set(xlabel=f"x ({unit})", ylabel=f"y ({unit})", zlabel="time (s)", zlim=(0, instance.horizon))
    ax.legend(loc="upper left", bbox_to_anchor=(-0.08, 1.02), frameon=False)
    return ax


def draw_targets(ax, instance):
    """Draw paths from above, each from a dot at its start, and windows; return them as lines for write_beside."""
    lines = []
    for target, path, in_windows in target_parts(instance):
        ax.plot(*path[:, :2].T, **PATH, **once(target, "target's path"))
        ax.plot(*path[0, :2], ".", color="0.45", zorder=3)
        lines += [(path, PATHS), *((window, WINDOWS) for window in in_windows)]
        for w, window in enumerate(in_windows):
            ax.plot(*window[:, :2].T, **in_print(WINDOW), **once(target + w, "time window"))
    return lines


def target_parts(instance):
    """Yield (number, path, parts of it inside windows) for each target; both as rows (x, y, t)."""
    of_type("instance", instance, Instance)
    for u, target in enumerate(instance.targets):
        windows = [_stretch(target, *window) for window in target.windows]
        yield u, _stretch(target, target.times[0], target.times[-1]), windows


def _stretch(target, start, end):
    """Return the corners (x, y, t) of a target's path from `start` to `end`."""
    bends = target.times[(target.times > start) & (target.times < end)]
    times = np.r_[start, bends, end]
    return np.c_[target.position(times), times]


def _flown(instance, tours):
    """Yield (stops, style, label) for each tour with a visit; stops as rows (x, y, t)."""
    for k, tour in enumerate(tours):
        if tour.visits:
            entry = agents_of(instance, tour)
            stops = [(*visit.position, visit.time) for visit in tour.visits]
            stops = [(*entry.depot, 0.0), *stops, (*entry.end, tour.return_time)]
            style = {
                "color": COLOURS[k % len(COLOURS)],
                "linestyle": LINES[k % len(LINES)],
                "marker": MARKERS[k % len(MARKERS)],
            }
            style |= {"linewidth": 1.8, "markersize": 6, "markevery": slice(1, -1), "zorder": 4}
            agent = f" (type {tour.agent})" if len(instance.agents) > 1 else ""
            yield np.array(stops), in_print(style), f"tour {k}{agent}, back at {tour.return_time:.0f} s"


def _count_idle(ax, instance, tours):
    """Put the number of agents without a visit into the legend, where there are tours and such agents."""
    idle = instance.n_agents - sum(bool(tour.visits) for tour in tours)
    if tours and idle > 0:
        nowhere = [[np.nan]] * (3 if ax.name == "3d" else 2)
        ax.plot(*nowhere, linestyle="none", label=counted(idle, "idle agent"))


def _visits(tours):
    return [visit for tour in tours for visit in tour.visits]


def window_numbers(instance, visits=()):
    """Yield (number, middle (x, y, t), style) of each window in which none of the visits is: words to write beside."""
    for u, _, in_windows in target_parts(instance):
        for window in in_windows:
            if not any(visit.target == u and window[0, 2] <= visit.time <= window[-1, 2] for visit in visits):
                middle = np.mean(window[[0, -1], 2])
                place = instance.targets[u].position(middle)
                yield str(u), (*place.tolist(), float(middle)), {"color": "0.35"}


def point_the_way(ax, stops, colour):
    """Put an arrowhead on each leg that has room for one; axes equal in x and y, stops as rows (x, y, ...)."""
    corners = ax.transData.transform(stops[:, :2]) * 72.0 / ax.figure.dpi
    size = 1.2 * rcParams["lines.markersize"]
    for (x, y), (u, v), (p, q) in zip(stops[:, :2], stops[1:, :2], itertools.pairwise(corners)):
        if np.hypot(*(q - p)) > 3 * size:
            turn = np.degrees(np.arctan2(v - y, u - x)) - 90
            head = {"marker": (3, 0, turn), "markersize": size, "color": colour, "linestyle": "none", "zorder": 4}
            ax.plot(0.6 * x + 0.4 * u, 0.6 * y + 0.4 * v, **head)  # not halfway: the way back may be the same


def _visited(tours):
    """Return (target and time, place, style) of each visit: words to write beside."""
    return [(f"{visit.target}: {visit.time:.0f} s", visit.position, {}) for visit in _visits(tours)]
