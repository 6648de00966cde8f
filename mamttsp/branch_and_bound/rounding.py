"""Tours from a fractional flow: take its edges from the heaviest on, as long as they fit together and can be flown."""

import numpy as np

from ..timing import earliest_times
from .loads import enough_agents, fits


def round_flow(graph, y, alive, counts):
    """Return routes (tuples of segments) through all targets that agents can fly, None if unlucky.

    counts: (K,) agents of each layer; y: (|E|,) flow; alive: (|E|,) edges that may be used, those without flow last.
    An edge of the depot with a flow of at least one half makes an end of a route; if that leaves too many routes, no
    edge does.
    """
    edges = np.flatnonzero(alive)
    edges = edges[np.argsort(-np.round(y[edges], 9), kind="stable")]
    return _join(graph, edges, edges[y[edges] >= 0.5], counts) or _join(graph, edges, [], counts)


def _join(graph, edges, heavy, counts):
    chains = _Chains(graph, graph.edges[heavy])
    between = (graph.tau[graph.edges[edges]] >= 0).all(axis=1)
    for i, j in graph.edges[edges[between]].tolist():
        chains.join(i, j)
    for i in graph.V_seg:
        chains.add(i)
    routes = sorted(set(chains.chain.values()))
    complete = len(chains.node) == graph.n_targets
    return routes if complete and enough_agents(graph, counts, routes) else None


class _Chains:
    """Chains of segments that grow at their ends; every chain can be flown from the depot and back."""

    def __init__(self, graph, ends):
        self.graph = graph
        self.first = {j for i, j in ends.tolist() if graph.tau[i] < 0}  # segments that must open a chain
        self.last = {i for i, j in ends.tolist() if graph.tau[j] < 0}  # segments that must end one
        self.chain = {}  # segment -> its chain, a tuple of segments
        self.node = {}  # target -> its segment
        for i in self.first | self.last:
            self.add(i)

    def add(self, i):
        """Visit segment i by a chain of its own, if its target is not visited yet and it can be flown."""
        if self.graph.tau[i] not in self.node and self._can_be_flown((i,)):
            self._keep((i,))

    def join(self, i, j):
        """Fly from i to j, if i ends a chain (or starts one), j opens another, and the whole can be flown."""
        if j in self.first or i in self.last or not (self._fits(i) and self._fits(j)):
            return
        before, after = self.chain.get(i, (i,)), self.chain.get(j, (j,))
        meet = before[-1] == i and after[0] == j and before != after
        if meet and self._can_be_flown(before + after):
            self._keep(before + after)

    def _can_be_flown(self, chain):
        return fits(self.graph, chain) and earliest_times(self.graph, chain) is not None

    def _fits(self, i):
        return self.node.get(self.graph.tau[i], i) == i

    def _keep(self, chain):
        for i in chain:
            self.chain[i] = chain
            self.node[self.graph.tau[i]] = i
