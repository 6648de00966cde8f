"""Drawings: tours from above, as in the paper's Fig. 1, and in space-time; and the ideas behind the formulations."""

import itertools

import matplotlib.pyplot as plt
import numpy as np

#: agents in turn: colours that the colour-blind can tell apart (Okabe and Ito), line styles and markers that need none
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000", "#56B4E9")
LINES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1)))
MARKERS = ("o", "s", "^", "D", "v")
PATH = {"color": "0.65", "linewidth": 1.0, "zorder": 1}
WINDOW = {"color": "#F5C45E", "linewidth": 5.0, "solid_capstyle": "butt", "zorder": 2}
DEPOT = {"color": "black", "marker": "*", "markersize": 14, "linestyle": "none", "zorder": 6}
_BOX = {"boxstyle": "round,pad=0.1", "facecolor": "white", "edgecolor": "none", "alpha": 0.7}
LABEL = {"fontsize": 9, "ha": "center", "va": "center", "zorder": 7, "bbox": _BOX}


def plan_view(instance, tours=(), ax=None):
    """Draw an instance from above, with tours if there are any, and return the axes.

    Target paths are grey, from a dot at their start; the parts inside time windows are thick and yellow; each agent
    has a colour, line style and marker of its own; each visit has its target's number beside it. Agents without a
    visit are in the legend as idle.
    """
    ax = ax or plt.figure(figsize=(8, 6), layout="constrained").add_subplot()
    for target, path, in_windows in _targets(instance):
        ax.plot(*path[:, :2].T, **PATH, **_once(target, "target's path"))
        ax.plot(*path[0, :2], ".", color="0.45", zorder=3)
        for w, window in enumerate(in_windows):
            ax.plot(*window[:, :2].T, **WINDOW, **_once(target + w, "time window"))
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
    for target, path, in_windows in _targets(instance):
        ax.plot(*path.T, **PATH, **_once(target, "target's path"))
        for w, window in enumerate(in_windows):
            ax.plot(*window.T, **WINDOW | {"linewidth": 4.0}, **_once(target + w, "time window"))
    for stops, style, label in _agents(instance, tours):
        ax.plot(*stops.T, **style, label=label)
    for visit in _visits(tours):
        ax.text(*visit.position, visit.time + 0.04 * instance.horizon, str(visit.target), **LABEL)
    ax.plot(*np.tile(instance.depot, (2, 1)).T, [0, instance.horizon], color="black", linestyle=":", linewidth=1.0)
    ax.plot(*instance.depot, 0.0, **DEPOT, label="depot")
    ax.set(xlabel="x (units)", ylabel="y (units)", zlabel="time (s)", zlim=(0, instance.horizon))
    ax.legend(loc="upper left", bbox_to_anchor=(-0.08, 1.02), frameon=False)
    return ax


def save(ax, path):
    """Write the figure that holds `ax` to path.pdf, to print, and path.png, to look at; each time the same bytes."""
    ax.figure.savefig(f"{path}.pdf", metadata={"CreationDate": None})
    ax.figure.savefig(f"{path}.png", dpi=150)


def _targets(instance):
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


def _once(k, label):
    """Return the legend's label for the first of its kind only."""
    return {"label": label} if k == 0 else {}


def charge_view(distance, size, ax=None):
    """Draw what a fraction of an edge costs in either convex program, against its flow y, and return the axes.

    distance: of the edge's ends, in units; size: R, the big-M. The baseline's (8)-(10) ask for
    l >= distance - R (1 - y), the perspectives (25), (26), (28), (29) for l >= y distance, ends held where they are.
    """
    ax = ax or plt.figure(figsize=(6, 4), layout="constrained").add_subplot()
    free = max(0.0, 1.0 - distance / size)
    ax.plot([0.0, 1.0], [0.0, distance], color=COLOURS[0], label="perspective: y d")
    big_m = {"color": COLOURS[1], "linestyle": "--", "label": "big-M: max(0, d - R (1 - y))"}
    ax.plot([0.0, free, 1.0], [0.0, 0.0, distance], **big_m)
    ax.plot([0.0, 1.0], [0.0, distance], "o", color="black", label="what a whole y costs")
    ax.set(xlabel="flow y on the edge", ylabel="least length l (units)")
    ax.legend(loc="upper left", frameon=False)
    return ax


def perspective_view(graph, i, shares=(0.25, 0.5, 0.75, 1.0), ax=None):
    """Draw the sets y X_i of node i, in one coordinate of space and time, for some shares y, and return the axes.

    X_i is the segment that (x, t) can be on; y X_i is the same segment drawn y times as far from the origin, and all
    of them together fill a cone.
    """
    ax = ax or plt.figure(figsize=(6, 5), layout="constrained").add_subplot()
    ends = np.array([[graph.p_lo[i][0], graph.t_lo[i]], [graph.p_hi[i][0], graph.t_hi[i]]])
    ax.fill(*np.vstack([[0.0, 0.0], ends]).T, color="0.92", zorder=0, label="all shares from 0 to 1")
    for k, y in enumerate(shares):
        style = {"color": COLOURS[k % len(COLOURS)], "linestyle": LINES[-k % len(LINES)], "linewidth": 2.0}
        ax.plot(*(y * ends).T, **style, label=f"y = {y:g}")
    ax.plot(0.0, 0.0, "o", color="black", label="y = 0")
    ax.set(xlabel="z_p, first coordinate (units)", ylabel="z_t (s)")
    ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0, frameon=False)
    return ax


def sizes_view(sizes, ax=None):
    """Draw how many variables formulations have for 1, 2, ... agents, and return the axes.

    sizes: dict from the name of a formulation to its numbers of variables, for m = 1, 2, ...
    """
    ax = ax or plt.figure(figsize=(6, 4), layout="constrained").add_subplot()
    for k, (name, numbers) in enumerate(sizes.items()):
        agents = range(1, len(numbers) + 1)
        ax.plot(agents, numbers, color=COLOURS[k], linestyle=LINES[k], marker=MARKERS[k], label=name)
        ax.set_xticks(agents)
    ax.set(xlabel="agents m", ylabel="variables")
    ax.set_ylim(bottom=0)
    ax.legend(loc="upper left", frameon=False)
    return ax


def reach_view(instance, place, time, meetings=(), ax=None):
    """Draw what an agent at (place, 0) at `time` can still reach, in x and time, and return the axes.

    For targets on the line y = 0: the agent's cone is grey, `meetings`, rows (x, t), are dots.
    """
    ax = ax or plt.figure(figsize=(7, 5), layout="constrained").add_subplot()
    T = instance.horizon
    far = instance.max_speed * (T - time)
    ax.fill([place, place - far, place + far], [time, T, T], color="0.92", zorder=0, label="can be reached")
    for target, path, in_windows in _targets(instance):
        ax.plot(*path[:, [0, 2]].T, **PATH, **_once(target, "target's path"))
        ax.annotate(str(target), path[-1, [0, 2]], xytext=(0, 8), textcoords="offset points", **LABEL)
        for w, window in enumerate(in_windows):
            ax.plot(*window[:, [0, 2]].T, **WINDOW, **_once(target + w, "time window"))
    ax.plot(*np.reshape(meetings, (-1, 2)).T, "o", color=COLOURS[0], zorder=4, label="earliest meeting")
    ax.plot(place, time, **DEPOT, label="agent")
    margin = 0.1 * instance.size
    xs = np.concatenate([instance.depot[:1], *(target.points[:, 0] for target in instance.targets)])
    ax.set(xlabel="x (units)", ylabel="time (s)", xlim=(xs.min() - margin, xs.max() + margin), ylim=(0, 1.08 * T))
    ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0, frameon=False)
    return ax


def graph_view(graph, route=(), ax=None):
    """Draw the graph of Section III, with a route's edges if there is one, and return the axes.

    s is at the left, s' at the right, a column between them holds the segments of one target, early ones below; edges
    are thin and grey, those of `route` (nodes of V_seg in order) thick and blue.
    """
    ax = ax or plt.figure(figsize=(9, 4.5), layout="constrained").add_subplot()
    places = _node_places(graph)
    flown = set(itertools.pairwise([graph.s, *route, graph.s_prime])) if route else set()
    for edge in map(tuple, graph.edges.tolist()):
        style = {"color": "0.75", "zorder": 1}
        if edge in flown:
            style = {"color": COLOURS[0], "linewidth": 2.2, "zorder": 3}
        arrow = {"arrowstyle": "-|>", "connectionstyle": "arc3,rad=0.12", "shrinkA": 11, "shrinkB": 11, **style}
        ax.annotate("", places[edge[1]], places[edge[0]], arrowprops=arrow, zorder=style["zorder"])
    for i, place in enumerate(places):
        ax.plot(*place, "o", markersize=20, color="white", markeredgecolor="black", zorder=4)
        name = {graph.s: "s", graph.s_prime: "s'"}.get(i, str(i))
        ax.annotate(name, place, fontsize=10, ha="center", va="center", zorder=5)
    low, high = places[:, 1].min() - 0.5, places[:, 1].max() + 0.5
    for u in range(graph.n_targets):
        ax.axvspan(u + 0.7, u + 1.3, color="#F5C45E", alpha=0.25, zorder=0)
        ax.text(u + 1.0, high, f"target {u}", ha="center", va="bottom")
    ax.set(xlim=(-0.4, graph.n_targets + 1.4), ylim=(low, high + 0.3))
    ax.axis("off")
    return ax


def _node_places(graph):
    """Return (|V|, 2): a column for each cluster, its segments around height 0."""
    places = np.zeros((len(graph.tau), 2))
    places[graph.s_prime, 0] = graph.n_targets + 1.0
    for u in range(graph.n_targets):
        nodes = graph.C(u)
        places[nodes] = np.c_[np.full(len(nodes), u + 1.0), np.arange(len(nodes)) - (len(nodes) - 1) / 2]
    return places


def descent_view(runs, optimum, ax=None):
    """Draw where a local method started and where it stopped, one column a run, and return the axes.

    runs: list of lists of lengths (units), from the first to the last; optimum: the proved optimum.
    """
    ax = ax or plt.figure(figsize=(7, 4), layout="constrained").add_subplot()
    runs = sorted(runs, key=lambda lengths: (round(lengths[-1], 6), lengths[0]))
    starts, ends = ([lengths[k] for lengths in runs] for k in (0, -1))
    number = range(1, len(runs) + 1)
    ax.vlines(number, ends, starts, color="0.75", zorder=1)
    ax.plot(number, starts, "o", color=COLOURS[5], label="start")
    ax.plot(number, ends, "s", color=COLOURS[1], label="stop")
    ax.axhline(optimum, color="black", linestyle="--", linewidth=1.0, label="proved optimum")
    ax.set(xlabel="start (a flyable route each)", ylabel="length (units)")
    ax.legend(loc="upper left", frameon=False)
    return ax
