"""Tours from above, as in the paper's Fig. 1, and in space-time."""

import itertools

import matplotlib.pyplot as plt
import numpy as np

from .style import COLOURS, DEPOT, LABEL, LINES, MARKERS, PATH, WINDOW, once


def plan_view(instance, tours=(), ax=None):
    """Draw an instance from above, with tours if there are any, and return the axes.

    Target paths are grey, from a dot at their start; the parts inside time windows are thick and yellow; each agent
    has a colour, line style and marker of its own; each visit has its target's number beside it. Agents without a
    visit are in the legend as idle.
    """
    ax = ax or plt.figure(figsize=(8, 6), layout="constrained").add_subplot()
    for target, path, in_windows in target_parts(instance):
        ax.plot(*path[:, :2].T, **PATH, **once(target, "target's path"))
        ax.plot(*path[0, :2], ".", color="0.45", zorder=3)
        for w, window in enumerate(in_windows):
            ax.plot(*window[:, :2].T, **WINDOW, **once(target + w, "time window"))
    for stops, style, label in _agents(instance, tours):
        ax.plot(*stops[:, :2].T, **style, label=label)
        for (x, y, _), (u, v, _) in itertools.pairwise(stops):
            middle = {"xytext": ((x + u) / 2, (y + v) / 2), "xy": (x + 0.51 * (u - x), y + 0.51 * (v - y))}
            ax.annotate("", **middle, arrowprops={"arrowstyle": "->", "color": style["color"]}, zorder=5)
    for visit, offset in _placed(_visits(tours), instance.size):
        ax.annotate(str(visit.target), visit.position, xytext=10 * offset, textcoords="offset points", **LABEL)
    ax.plot(*instance.depot, **DEPOT, label="depot")
    ax.set(xlabel="x (units)", ylabel="y (units)", aspect="equal")
    ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0, frameon=False)
    return ax


def space_time_view(instance, tours=(), ax=None):
    """Draw an instance in space and time, time upwards, with tours if there are any, and return the (3D) axes.

    A target's path is a line that rises as time goes on; a visit is where an agent's line touches it, inside a window.
    Agents are drawn at constant speed on each leg; the dotted upright line is the depot. Colours as in plan_view.
    """
    ax = ax or plt.figure(figsize=(8, 7), layout="constrained").add_subplot(projection="3d", computed_zorder=False)
    for target, path, in_windows in target_parts(instance):
        ax.plot(*path.T, **PATH, **once(target, "target's path"))
        for w, window in enumerate(in_windows):
            ax.plot(*window.T, **WINDOW | {"linewidth": 4.0}, **once(target + w, "time window"))
    for stops, style, label in _agents(instance, tours):
        ax.plot(*stops.T, **style, label=label)
    for visit in _visits(tours):
        ax.text(*visit.position, visit.time + 0.04 * instance.horizon, str(visit.target), **LABEL)
    ax.plot(*np.tile(instance.depot, (2, 1)).T, [0, instance.horizon], color="black", linestyle=":", linewidth=1.0)
    ax.plot(*instance.depot, 0.0, **DEPOT, label="depot")
    ax.set(xlabel="x (units)", ylabel="y (units)", zlabel="time (s)", zlim=(0, instance.horizon))
    ax.legend(loc="upper left", bbox_to_anchor=(-0.08, 1.02), frameon=False)
    return ax


def target_parts(instance):
    """Yield (number, path, parts of it inside windows) for each target; both as rows (x, y, t)."""
    for u, target in enumerate(instance.targets):
        windows = [_stretch(target, *window) for window in target.windows]
        yield u, _stretch(target, target.times[0], target.times[-1]), windows


def _stretch(target, start, end):
    """Return the corners (x, y, t) of a target's path from `start` to `end`."""
    bends = target.times[(target.times > start) & (target.times < end)]
    times = np.r_[start, bends, end]
    return np.c_[target.position(times), times]


def _agents(instance, tours):
    """Yield (stops, style, label) for each agent, those that stay at home too; stops as rows (x, y, t)."""
    for k in range(max(instance.n_agents, len(tours))):
        visits = tours[k].visits if k < len(tours) else ()
        stops = [(*instance.depot, 0.0), *((*visit.position, visit.time) for visit in visits)]
        if visits:
            stops.append((*instance.depot, tours[k].return_time))
        style = {"color": COLOURS[k % len(COLOURS)], "linestyle": LINES[k % len(LINES)], "linewidth": 1.8, "zorder": 4}
        style |= {"marker": MARKERS[k % len(MARKERS)], "markersize": 6, "markevery": slice(1, -1) if visits else []}
        yield np.array(stops), style, f"agent {k + 1}" + ("" if visits else " (idle)")


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
