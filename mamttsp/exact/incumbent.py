"""The incumbent: real tours only, each route timed by the SOCP once."""

import math

import numpy as np
from scipy import sparse

from ..timing import bounded_times, to_tour
from .partition import choose

#: how many routes of a forest are timed exactly in search of better tours, for each target
_TIMED = 5
#: how many columns a heuristic choice looks at, and for how many seconds
_FEW, _SECONDS = 3000, 1.0


class Incumbent:
    """The best tours so far. routes: tuples of segments; objective: their length, infinite without routes."""

    def __init__(self, graph, n_agents):
        self.graph, self.m = graph, n_agents
        self.objective, self.routes = math.inf, ()
        self._timed = {}

    def timed(self, route):
        """Return (length, times, bound) of a route of segments, see `bounded_times`, or None if it cannot be flown."""
        if route not in self._timed:
            self._timed[route] = bounded_times(self.graph, list(route))
        return self._timed[route]

    def offer(self, routes):
        """Take the routes if all can be flown and they are shorter than the incumbent."""
        found = [self.timed(route) for route in routes]
        if all(found) and (total := sum(length for length, _, _ in found)) < self.objective:
            self.objective, self.routes = total, tuple(routes)

    def recombine(self, targets):
        """Offer the best choice among all routes of these targets that were ever timed."""
        routes = [route for route, found in self._timed.items() if found]
        if self.m > 1 and routes:
            self.offer_choice(routes, targets, time_limit=_SECONDS)

    def offer_choice(self, routes, targets, time_limit=None):
        """Offer the best choice among routes that can be flown."""
        visited = [set(self.graph.tau[list(route)]) for route in routes]
        visits = np.array([[float(u in route) for route in visited] for u in targets])
        costs = np.array([self.timed(route)[0] for route in routes])
        _, chosen = choose(sparse.csc_matrix(visits), costs, self.m, time_limit)
        if chosen is not None:
            self.offer([routes[j] for j in chosen])

    def improve(self, forest, candidates):
        """Time the most promising columns of a forest exactly, and offer the best choice among them.

        candidates: columns to consider.
        """
        order = candidates[np.argsort(forest.bound[candidates], kind="stable")]
        most = _TIMED * forest.members.shape[0]
        favourites = ()
        if self.m > 1 and len(order) > most:
            few = order[:_FEW]
            _, chosen = choose(forest.members[:, few], forest.cost[few], self.m, time_limit=_SECONDS)
            favourites = () if chosen is None else few[chosen]
        routes = {}
        for column in (*favourites, *order):
            if forest.bound[column] >= self.objective:  # in no better tours, nor are those that follow
                break
            route = forest.segments(column)
            if self.timed(route) is not None:
                routes.setdefault(route, column)
                if self.m == 1:
                    self.offer([route])
            if len(routes) >= most:
                break
        if routes:
            costs = np.array([self.timed(route)[0] for route in routes])
            _, chosen = choose(forest.members[:, list(routes.values())], costs, self.m, time_limit=_SECONDS)
            if chosen is not None:
                known = list(routes)
                self.offer([known[j] for j in chosen])

    def columns(self, targets, cutoff):
        """Return (visits (J, n), cost (J,)) of the incumbent's routes; without one, of a tour at the cutoff."""
        if not self.routes:
            return np.ones((1, len(targets))), np.array([min(cutoff, 10.0 * self.graph.size)])
        visited = [set(self.graph.tau[list(route)]) for route in self.routes]
        visits = np.array([[float(u in route) for u in targets] for route in visited])
        return visits, np.array([self.timed(route)[0] for route in self.routes])

    def visit_times(self):
        """Return {segment: visit time} of the incumbent."""
        return {i: t for route in self.routes for i, t in zip(route, self.timed(route)[1])}

    def tours(self):
        return tuple(to_tour(self.graph, list(route), self.timed(route)[1]) for route in self.routes)
