"""The best tours that a search has found."""

import math

import numpy as np

from ..flow import read_flow
from ..formulations.points import routes_of
from ..timing import best_tours
from .beam import beam_routes
from .loads import enough_agents, fits
from .rounding import round_flow


class BestFound:
    """The shortest tours so far: their length (units, infinity without any) and their flow (|E|,), None without any."""

    def __init__(self, graph, counts):
        self.graph, self.counts = graph, counts
        self.length, self.flow = math.inf, None
        self._tried = set()

    def begin_from(self, tours):
        """Take the tours, at the best times for their order."""
        self._take(routes_of(self.graph, self.counts, tours))

    def near(self, y, alive):
        """Try tours near the flow y (|E|,) on the edges in `alive`."""
        self._take(round_flow(self.graph, y, alive, self.counts))

    def along(self, extra, alive, times):
        """Try tours along the edges that add least to a bound, `extra` (|E|,) each, with the times of `propagate`."""
        for routes in beam_routes(self.graph, extra, alive, times, self.counts):
            self._take(routes)

    def on(self, alive):
        """Try the tours that fly every edge in `alive`, which must be paths and cycles through all targets."""
        paths, cycles = read_flow(self.graph, alive)
        carried = all(fits(self.graph, path) for path in paths)
        if not cycles and carried and enough_agents(self.graph, self.counts, paths):
            self._take(paths)

    def _take(self, routes):
        """Take the routes, with their best times, if they can be flown and are shorter."""
        if routes is None or (key := tuple(routes)) in self._tried:
            return
        self._tried.add(key)
        found = best_tours(self.graph, [list(route) for route in routes])
        if found is not None and found[0] < self.length:
            self.length, self.flow = found[0], _flow_of(self.graph, routes)


def _flow_of(graph, routes):
    """Return the flow (|E|,) of routes through the graph."""
    number = {edge: e for e, edge in enumerate(map(tuple, graph.edges.tolist()))}
    flow = np.zeros(len(graph.edges))
    for route in routes:
        layer = graph.layer[route[0]]
        stops = [graph.starts[layer], *route, graph.ends[layer]]
        flow[[number[edge] for edge in zip(stops[:-1], stops[1:])]] = 1.0
    return flow
