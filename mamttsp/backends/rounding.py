"""Tours from a fractional flow: take its edges from the heaviest on, as long as they fit together and can be flown."""

import numpy as np

from ..tours import earliest_times


def round_flow(graph, y, alive, n_agents):
    """Return routes (tuples of segments) through every target that can be flown, at most `n_agents`, or None.

    y: (|E|,) flow; alive: (|E|,) the edges that may be used: those without flow come last.
    """
    chains = _Chains(graph)
    edges = np.flatnonzero(alive)
    for e in edges[np.argsort(-np.round(y[edges], 9), kind="stable")]:
        chains.join(*graph.edges[e].tolist())
    return chains.routes(n_agents)


class _Chains:
    """Chains of segments that grow at their ends; every chain can be flown from the depot and back."""

    def __init__(self, graph):
        self.graph = graph
        self.chain = {}  # segment -> its chain, a tuple of segments
        self.node = {}  # target -> its segment

    def join(self, i, j):
        """Use the edge (i, j) if it fits what is there."""
        if self.graph.s in (i, j) or self.graph.s_prime in (i, j):
            return
        if not (self._fits(i) and self._fits(j)):
            return
        before, after = self._chain(i), self._chain(j)
        if before[-1] == i and after[0] == j and before != after and earliest_times(self.graph, before + after) is not None:
            self._keep(before + after)

    def routes(self, n_agents):
        """Return the chains, if they visit every target and there are agents enough."""
        chains = set(self.chain.values())
        complete = len(self.node) == self.graph.n_targets
        return sorted(chains) if complete and len(chains) <= n_agents else None

    def _fits(self, i):
        return self.node.get(self.graph.tau[i], i) == i

    def _chain(self, i):
        return self.chain.get(i, (i,))

    def _keep(self, chain):
        for i in chain:
            self.chain[i] = chain
            self.node[self.graph.tau[i]] = i
