"""The incumbent: real tours only, each route timed by the SOCP once."""

import math

import numpy as np
from scipy import sparse

from ..timing import bounded_times, to_tour
from .partition import choose


class Incumbent:
    """The best tours of a Fleet so far. routes: tuples of segments; objective: their length, infinite without them."""

    def __init__(self, graph, fleet):
        self.graph, self.fleet = graph, fleet
        self.objective, self.routes = math.inf, ()
        self._timed, self._combined = {}, 0

    @property
    def longest(self):
        """No solution is longer: no agent flies further than v_max T."""
        return float(self.fleet.counts @ self.graph.speeds) * self.graph.horizon

    def timed(self, route):
        """Return (length, times, bound) of a route of segments, see `bounded_times`, or None if it cannot be flown."""
        if route not in self._timed:
            self._timed[route] = bounded_times(self.graph, list(route))
        return self._timed[route]

    def offer(self, routes):
        """Take the routes if all can be flown and they are shorter than the incumbent; return whether they are."""
        found = [self.timed(route) for route in routes]
        if not all(found) or (total := sum(length for length, _, _ in found)) >= self.objective:
            return False
        self.objective, self.routes = total, tuple(routes)
        return True

    def recombine(self, time_limit):
        """Offer the best choice among the shortest routes, of each layer through each set of targets, ever timed."""
        if len(self._timed) == self._combined:  # the same routes as the last time
            return
        best, self._combined = {}, len(self._timed)
        for route, found in self._timed.items():
            served = int(self.graph.layer[route[0]]), frozenset(self.graph.tau[list(route)])
            if found and (served not in best or found[0] < self.timed(best[served])[0]):
                best[served] = route
        if not best:
            return
        starts = np.cumsum([0] + [len(served) for _, served in best])
        served = np.concatenate([sorted(served) for _, served in best])
        members = sparse.csc_matrix((np.ones(len(served)), served, starts), shape=(self.graph.n_targets, len(best)))
        lengths = np.array([self.timed(route)[0] for route in best.values()])
        agents = np.array([layer for layer, _ in best])
        limit = min(self.objective, self.longest)
        _, chosen = choose(members, agents, lengths, self.fleet, limit, self.graph.size or 1.0, time_limit)
        if chosen is not None:
            routes = list(best.values())
            self.offer([routes[j] for j in chosen])

    def visit_times(self):
        """Return {segment: visit time} of the incumbent."""
        return {i: t for route in self.routes for i, t in zip(route, self.timed(route)[1])}

    def tours(self):
        return tuple(to_tour(self.graph, list(route), self.timed(route)[1]) for route in self.routes)
