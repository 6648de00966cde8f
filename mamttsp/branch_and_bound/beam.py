"""Tours along the edges that add least to the bound: a beam over partial tours, each flown as early as can be.

By a relaxation's duals a set of tours is at least as long as the bound and what each of its edges adds to it. Partial
tours with equally many visits are compared by that sum, and the best few are continued.
"""

import dataclasses

import numpy as np

from ..compiled import compiled
from .propagation import earliest_arrival

#: partial tours that are kept of each number of visits, and complete ones that are returned
_WIDTH, _COMPLETE = 100, 5


@dataclasses.dataclass(frozen=True, eq=False)
class _Partial:
    """Partial tours, side by side: where the last agent is, from when on, what all edges add, targets visited, agents
    of each layer used, load of the last one, and segments in order (-1: back at the depot)."""

    node: np.ndarray
    time: np.ndarray
    cost: np.ndarray
    visited: np.ndarray
    used: np.ndarray
    load: np.ndarray
    order: np.ndarray

    def pick(self, which):
        return _Partial(*(value[which] for value in vars(self).values()))

    def plus(self, other):
        return _Partial(*map(np.concatenate, zip(vars(self).values(), vars(other).values())))


def beam_routes(graph, extra, alive, times, counts):
    """Return sets of routes (tuples of segments) on the edges in `alive`, the best first; each can be flown.

    extra: (|E|,) what an edge adds to the bound; times: (|E|, 4) of `propagate`; counts: (K,) agents of each layer.
    """
    search = _Beam(graph, extra, alive, times, counts)
    partial = search.begun()
    for _ in range(graph.n_targets):
        partial = search.longer(partial)
    complete = search.home(partial)
    best = np.argsort(complete.cost, kind="stable")[:_COMPLETE]
    return [_routes(order) for order in complete.order[best].tolist()]


def _routes(order):
    routes = [[]]
    for i in order:
        if i >= 0:
            routes[-1].append(i)
        elif i == -1:
            routes.append([])
    return sorted(tuple(route) for route in routes if route)


class _Beam:
    def __init__(self, graph, extra, alive, times, counts):
        self.graph, self.counts = graph, counts
        edges = np.flatnonzero(alive)
        self.tail, self.head = graph.edges[edges].T
        self.extra, self.leave, self.arrive = extra[edges], times[edges, 1], times[edges, 3]
        self.target = graph.tau[self.head]
        self.latest = np.full(len(graph.tau), -np.inf)
        np.maximum.at(self.latest, self.tail, self.leave)

    def begun(self):
        """Return an agent of each layer at its depot."""
        K = len(self.counts)
        visited, order = np.zeros((K, self.graph.n_targets), dtype=bool), np.empty((K, 0), dtype=int)
        zero = np.zeros(K)
        return _Partial(self.graph.starts.copy(), zero, zero, visited, np.eye(K, dtype=int), zero, order)

    def home(self, partial):
        """Return the partial tours whose agent can fly home from where it is, once it is there."""
        of, edge = np.nonzero((partial.node[:, None] == self.tail) & (self.target < 0))
        soon = partial.time[of] <= self.leave[edge]
        of, edge = of[soon], edge[soon]
        there = partial.pick(of)
        back = np.full((len(of), 1), -1)
        return dataclasses.replace(
            there, node=self.head[edge], cost=there.cost + self.extra[edge], order=np.hstack([there.order, back])
        )

    def longer(self, partial):
        """Return the best partial tours with one visit more, by the same agent or by another one."""
        stay = dataclasses.replace(partial, order=np.pad(partial.order, ((0, 0), (0, 1)), constant_values=-2))
        partial = stay.plus(self._next_agents(self.home(partial)))
        of, edge = np.nonzero((partial.node[:, None] == self.tail) & (self.target >= 0))
        before = partial.pick(of)
        load = before.load + self.graph.demands[self.target[edge]]
        fits = ~before.visited[np.arange(len(of)), self.target[edge]] & (load <= self.graph.room[self._layer(before)])
        of, edge, load = of[fits], edge[fits], load[fits]
        time = self._arrivals(partial.node[of], partial.time[of], self.head[edge], self.arrive[edge])
        cost = partial.cost[of] + self.extra[edge]
        best = np.lexsort((time, cost))
        best = best[np.isfinite(time[best])]
        found = partial.pick(of[best])
        visited = found.visited.copy()
        visited[np.arange(len(best)), self.target[edge[best]]] = True
        node = self.head[edge[best]]
        order = np.hstack([found.order, node[:, None]])
        found = _Partial(node, time[best], cost[best], visited, found.used, load[best], order)
        found = found.pick(_not_worse(np.hstack([found.visited, found.used, node[:, None]]), found.time)[: 4 * _WIDTH])
        return found.pick(self._open(found)[:_WIDTH])

    def _layer(self, partial):
        return self.graph.layer[partial.node]

    def _next_agents(self, partial):
        """Return the partial tours with an agent more at its depot, in every way."""
        of, layer = np.nonzero(partial.used < self.counts)
        found = partial.pick(of)
        used = found.used.copy()
        used[np.arange(len(of)), layer] += 1
        zero = np.zeros(len(of))
        return dataclasses.replace(found, node=self.graph.starts[layer], time=zero, load=zero, used=used)

    def _open(self, partial):
        """Return which partial tours can still reach each target, or have an agent left for it."""
        reached = partial.visited | (partial.used < self.counts).any(axis=1)[:, None]
        of, segment = np.nonzero(~reached[:, np.maximum(self.graph.tau, 0)] & (self.graph.tau >= 0))
        time = self._arrivals(partial.node[of], partial.time[of], segment, self.latest[segment])
        soon = np.isfinite(time)
        reached[of[soon], self.graph.tau[segment[soon]]] = True
        return np.flatnonzero(reached.all(axis=1))

    def _arrivals(self, i, t, j, end):
        g = self.graph
        return _arrivals(i, t, j, end, g.t_lo, g.p_lo, g.v, g.speeds[g.layer[i]])


def _not_worse(rows, time):
    """Return which partial tours, the cheapest first, are the first or the earliest among those with equal rows."""
    group = np.unique(rows, axis=0, return_inverse=True)[1].ravel()
    by_time = np.argsort(time, kind="stable")
    first = np.unique(group, return_index=True)[1]
    earliest = by_time[np.unique(group[by_time], return_index=True)[1]]
    return np.union1d(first, earliest)


@compiled
def _arrivals(i, t, j, end, t_lo, p_lo, v, speed):
    """Return the earliest times up to `end` at j after leaving i at time t, infinity if there is none, for each."""
    found = np.empty(len(i))
    for k in range(len(i)):
        found[k] = earliest_arrival(i[k], j[k], t[k], t_lo[j[k]], end[k], t_lo, p_lo, v, speed[k])
    return found
