"""The optimum of instances too large for tests/oracle.py: enumeration of orders, cut short by a crude lower bound.

Every segment is cut into short slices. Between two slices an agent flies at least the distance of their middles less
half of both lengths, so a table over (set of visited targets, slice) bounds every tour from below, and the routes whose
bound lies below the best one are timed one by one. It shares with the package the graph's nodes, the best times of one
fixed order and nothing of `mamttsp.exact`; tests/exact/test_enumeration.py holds it against tests/oracle.py.
"""

import math

import numpy as np

from mamttsp import build_graph
from mamttsp.timing import best_times, earliest_times

_SLICES = 16


def optimum(instance):
    """Return the least total length of at most `n_agents` tours that visit every target once; inf if there is none."""
    shortest = ShortestTours(instance)
    everyone = (1 << instance.n_targets) - 1
    while True:
        total, parts = _cheapest_partition(shortest.bound, everyone, instance.n_agents)
        if math.isinf(total) or all(part in shortest.exact for part in parts):
            return total
        for part in parts:
            shortest.settle(part)


def _cheapest_partition(cost, everyone, n_agents):
    """Return (total, parts): the cheapest division of the targets into at most n_agents sets (bit masks)."""
    best = {0: (0.0, ())}
    for _ in range(n_agents):
        longer = dict(best)
        for S in range(1, everyone + 1):
            first, own = S & -S, S
            while own:  # every subset of S that holds its first target: some part must
                if own & first and (rest := best.get(S ^ own)) is not None and math.isfinite(cost[own]):
                    total = cost[own] + rest[0]
                    if S not in longer or total < longer[S][0]:
                        longer[S] = total, (*rest[1], own)
                own = (own - 1) & S
        best = longer
    return best.get(everyone, (math.inf, ()))


class ShortestTours:
    """One agent's shortest tour through each set of targets (bit mask): bound[S] from below, exact[S] where settled."""

    def __init__(self, instance):
        self.graph = build_graph(instance)
        self.n = instance.n_targets
        self.exact = {}
        self._slice()
        self._tabulate()

    def _slice(self):
        """Cut the segments; `hop` is the least distance between slices, infinite where no agent is in time."""
        graph = self.graph
        rows = [(i, k) for i in graph.V_seg for k in range(_SLICES if graph.t_hi[i] > graph.t_lo[i] else 1)]
        self.node = np.array([i for i, _ in rows])
        step = (graph.t_hi - graph.t_lo)[self.node] / _SLICES
        start = graph.t_lo[self.node] + np.array([k for _, k in rows]) * step
        middle, self.target = self._place(start + step / 2), graph.tau[self.node]
        radius = np.hypot(*graph.v[self.node].T) * step / 2
        soonest, latest = self._place(start), self._place(start + step)
        late = graph.max_speed * 1e-6 * graph.horizon
        self.hop = np.maximum(_distances(middle, middle) - radius[:, None] - radius, 0.0)
        self.hop[_distances(soonest, latest) > graph.max_speed * (start + step - start[:, None]) + late] = np.inf
        home = graph.p_lo[:1]
        to_home = np.maximum(_distances(home, middle)[0] - radius, 0.0)
        self.first = np.where(_distances(home, latest)[0] > graph.max_speed * (start + step) + late, np.inf, to_home)
        in_time = _distances(home, soonest)[0] <= graph.max_speed * (graph.horizon - start) + late
        self.last = np.where(in_time, to_home, np.inf)

    def _place(self, times):
        graph = self.graph
        return graph.p_lo[self.node] + (times - graph.t_lo[self.node])[:, None] * graph.v[self.node]

    def _tabulate(self):
        """so_far[S]: least way from the depot through the targets in S to each slice of one of them."""
        mine = [np.flatnonzero(self.target == u) for u in range(self.n)]
        self.so_far = np.full((1 << self.n, len(self.node)), np.inf)
        for S in range(1, 1 << self.n):
            for u in _members(S):
                before = S ^ 1 << u
                if before:
                    self.so_far[S, mine[u]] = np.min(self.so_far[before][:, None] + self.hop[:, mine[u]], axis=0)
                else:
                    self.so_far[S, mine[u]] = self.first[mine[u]]
        self.bound = np.min(self.so_far + self.last, axis=1)

    def settle(self, S):
        """Set bound[S] to the length of the shortest tour through S, infinity if there is none."""
        self.best = math.inf
        self._search(S, (), self.last)
        self.exact[S] = self.bound[S] = self.best

    def _search(self, S, route, to_go):
        """Try every way to visit the targets in S before `route`; to_go: least way home from each slice through it."""
        if not S:
            if earliest_times(self.graph, route) is not None:
                self.best = min(self.best, best_times(self.graph, list(route))[0])
            return
        choices = []
        for i in self.graph.V_seg:
            if S >> self.graph.tau[i] & 1:
                here = self.node == i
                bound = np.min(self.so_far[S][here] + to_go[here])
                if math.isfinite(bound):
                    choices.append((bound, i))
        for bound, i in sorted(choices):
            if bound >= self.best:
                return
            here = self.node == i
            rest = S ^ 1 << int(self.graph.tau[i])
            before = np.min(self.hop[:, here] + to_go[here], axis=1) if rest else None
            self._search(rest, (i, *route), before)


def _members(S):
    return [u for u in range(S.bit_length()) if S >> u & 1]


def _distances(p, q):
    return np.hypot(*(p[:, None] - q[None]).transpose(2, 0, 1))
