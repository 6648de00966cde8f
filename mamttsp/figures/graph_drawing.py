"""Reachable sets, and the graph of Section III."""

import itertools

import numpy as np

from ..graph import Graph
from ..instance import Instance
from ..validation import array, floats, listed, number, of_type, whole
from .canvas import canvas
from .plan import target_parts
from .style import COLOURS, DEPOT, LABEL, PATH, WINDOW, once


def reach_view(instance, place, time, meetings=(), ax=None):
    """Draw what an agent at (place, 0) at `time` can still reach, in x and time, and return the axes.

    For targets on the line y = 0: the agent's cone is grey, `meetings`, rows (x, t), are dots. InputError: not an
    Instance, a place or time that is no number, meetings that are no such rows, or no axes.

    >>> from mamttsp import Instance
    >>> from mamttsp.figures import reach_view
    >>> fleet = {"n_agents": 1, "depot": (0, 0), "max_speed": 4}
    >>> road = Instance.from_arrays(p=[[10, 0]], v=[[0.5, 0]], windows=[(5, 15)], horizon=20, **fleet)
    >>> reach_view(road, place=0.0, time=0.0, meetings=[(12.5, 5.0)]).get_ylabel()
    'time (s)'
    """
    of_type("instance", instance, Instance)
    place, time = number("place", place), number("time", time)
    meetings = floats("meetings", meetings, "rows (x, t)")
    meetings = array("meetings", meetings if meetings.size else np.empty((0, 2)), (-1, 2))
    ax = canvas(ax, (7, 5))
    T = instance.horizon
    far = instance.max_speed * (T - time)
    ax.fill([place, place - far, place + far], [time, T, T], color="0.92", zorder=0, label="can be reached")
    for target, path, in_windows in target_parts(instance):
        ax.plot(*path[:, [0, 2]].T, **PATH, **once(target, "target's path"))
        ax.annotate(str(target), path[-1, [0, 2]], xytext=(0, 8), textcoords="offset points", **LABEL)
        for w, window in enumerate(in_windows):
            ax.plot(*window[:, [0, 2]].T, **WINDOW, **once(target + w, "time window"))
    ax.plot(*meetings.T, "o", color=COLOURS[0], zorder=4, label="earliest meeting")
    ax.plot(place, time, **DEPOT, label="agent")
    margin = 0.1 * instance.size
    xs = np.concatenate([instance.depot[:1], *(target.points[:, 0] for target in instance.targets)])
    ax.set(xlabel="x (units)", ylabel="time (s)", xlim=(xs.min() - margin, xs.max() + margin))
    ax.set_ylim(-0.05 * T, 1.08 * T)  # room for a whole star at time 0
    ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0, frameon=False)
    return ax


def graph_view(graph, route=(), ax=None):
    """Draw the graph of Section III, with a route's edges if there is one, and return the axes.

    s is at the left, s' at the right, a column between them holds the segments of one target, early ones below; edges
    are thin and grey, those of `route` (nodes of V_seg in order) thick and blue. InputError: not a Graph, a route of
    something else than nodes, or no axes.

    >>> from mamttsp import build_graph, generate
    >>> from mamttsp.figures import graph_view
    >>> ax = graph_view(build_graph(generate(n_targets=3, total_window=20, seed=1)))
    >>> [text.get_text() for text in ax.texts if "target" in text.get_text()]
    ['target 0', 'target 1', 'target 2']
    """
    of_type("graph", graph, Graph)
    route = [whole("route", node, 0) for node in listed("route", route, object)]
    ax = canvas(ax, (9, 4.5))
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
        ax.axvspan(u + 0.7, u + 1.3, color=WINDOW["color"], alpha=0.25, zorder=0)
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
