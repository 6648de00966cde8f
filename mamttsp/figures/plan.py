"""Tours from above, as in the paper's Fig. 1, and in space-time."""

import itertools

import matplotlib.pyplot as plt
import numpy as np

from ..instance import Instance
from ..tours import agents_of, as_tours
from ..validation import counted, of_type
from .depots import depots
from .style import COLOURS, LABEL, LINES, MARKERS, PATH, WINDOW, once


def plan_view(instance, tours=(), ax=None):
    """Draw an instance from above, with tours if there are any, and return the axes.

    tours: a Solution, or a sequence of Tour. Target paths are grey, from a dot at their start; the parts inside time
    windows are thick and yellow; each tour has a colour, line style and marker of its own; each visit has its target's
    number beside it. Targets and tours have the numbers of files and code, from 0. The legend counts idle agents.
    InputError: not an Instance, or no tours.

    >>> from mamttsp import generate
    >>> from mamttsp.figures import plan_view
    >>> ax = plan_view(generate(n_targets=3, total_window=20, seed=1))
    >>> ax.get_xlabel()
    'x (units)'
    """
    tours = as_tours(tours)
    ax = ax or plt.figure(figsize=(8, 6), layout="constrained").add_subplot()
    for target, path, in_windows in target_parts(instance):
        ax.plot(*path[:, :2].T, **PATH, **once(target, "target's path"))
        ax.plot(*path[0, :2], ".", color="0.45", zorder=3)
        for w, window in enumerate(in_windows):
            ax.plot(*window[:, :2].T, **WINDOW, **once(target + w, "time window"))
    for stops, style, label in _flown(instance, tours):
        ax.plot(*stops[:, :2].T, **style, label=label)
        for (x, y, _), (u, v, _) in itertools.pairwise(stops):
            middle = {"xytext": ((x + u) / 2, (y + v) / 2), "xy": (x + 0.51 * (u - x), y + 0.51 * (v - y))}
            ax.annotate("", **middle, arrowprops={"arrowstyle": "->", "color": style["color"]}, zorder=5)
    for visit, offset in _placed(_visits(tours), instance.size):
        ax.annotate(str(visit.target), visit.position, xytext=10 * offset, textcoords="offset points", **LABEL)
    for place, style, label in depots(instance):
        ax.plot(*place, **style, label=label)
    _count_idle(ax, instance, tours)
    ax.set(xlabel="x (units)", ylabel="y (units)", aspect="equal")
    ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0, frameon=False)
    return ax


def space_time_view(instance, tours=(), ax=None):
    """Draw an instance in space and time, time upwards, with tours if there are any, and return the (3D) axes.

    A target's path is a line that rises as time goes on; a visit is where an agent's line touches it, inside a window.
    tours: a Solution, or a sequence of Tour. Each is drawn at constant speed on each leg; dotted upright lines are
    depots and ends. Colours and numbers as in plan_view. InputError: not an Instance, or no tours.
    """
    tours = as_tours(tours)
    ax = ax or plt.figure(figsize=(8, 7), layout="constrained").add_subplot(projection="3d", computed_zorder=False)
    for target, path, in_windows in target_parts(instance):
        ax.plot(*path.T, **PATH, **once(target, "target's path"))
        for w, window in enumerate(in_windows):
            ax.plot(*window.T, **WINDOW | {"linewidth": 4.0}, **once(target + w, "time window"))
    for stops, style, label in _flown(instance, tours):
        ax.plot(*stops.T, **style, label=label)
    for visit in _visits(tours):
        ax.text(*visit.position, visit.time + 0.04 * instance.horizon, str(visit.target), **LABEL)
    for place, style, label in depots(instance):
        ax.plot(*np.tile(place, (2, 1)).T, [0, instance.horizon], color="black", linestyle=":", linewidth=1.0)
        ax.plot(*place, 0.0, **style, label=label)
    _count_idle(ax, instance, tours)
    ax.set(xlabel="x (units)", ylabel="y (units)", zlabel="time (s)", zlim=(0, instance.horizon))
    ax.legend(loc="upper left", bbox_to_anchor=(-0.08, 1.02), frameon=False)
    return ax


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
            yield np.array(stops), style, f"tour {k} (type {tour.agent})" if len(instance.agents) > 1 else f"tour {k}"


def _count_idle(ax, instance, tours):
    """Put the number of agents without a visit into the legend, where there are tours and such agents."""
    idle = instance.n_agents - sum(bool(tour.visits) for tour in tours)
    if tours and idle > 0:
        nowhere = [[np.nan]] * (3 if ax.name == "3d" else 2)
        ax.plot(*nowhere, linestyle="none", label=counted(idle, "idle agent"))


def _visits(tours):
    return [visit for tour in tours for visit in tour.visits]


def _placed(visits, size):
    """Yield (visit, direction of its label), each label where it is farthest from other labels and visits."""
    directions = [np.array([np.cos(angle), np.sin(angle)]) for angle in np.pi / 4 * np.arange(1, 9)]
    taken = [np.asarray(visit.position) for visit in visits]
    for k, visit in enumerate(visits):
        others = taken[:k] + taken[k + 1 :]
        places = [visit.position + 0.03 * size * direction for direction in directions]
        room = [min((np.hypot(*(place - other)) for other in others), default=0.0) for place in places]
        best = int(np.argmax(room))
        taken.append(places[best])
        yield visit, directions[best]
