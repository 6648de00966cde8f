"""How many routes a solution may have, of each layer of the graph (type of agents), and how many it must have."""

import dataclasses

import numpy as np


@dataclasses.dataclass(frozen=True, eq=False)
class Fleet:
    """counts: (K,) routes of each layer at most; least: routes of all layers together at least."""

    counts: np.ndarray
    least: int

    @classmethod
    def of(cls, graph):
        """Return the Fleet of a graph: as many routes are needed as it takes of the largest capacities to carry all
        demands, one more than there are agents if none suffices."""
        counts = np.minimum(graph.counts, graph.n_targets)
        room = np.sort(np.repeat(graph.room, counts))[::-1]
        return cls(counts, 1 + int((np.cumsum(room) < graph.demands.sum()).sum()))

    @property
    def n_agents(self):
        """How many routes there are at most."""
        return int(self.counts.sum())

    def total(self, cheapest):
        """Return the least sum over any permitted routes, where each of layer k costs at least cheapest[k]: infinite if
        too few can be flown."""
        return _total(cheapest, self.counts, self.least)

    def rest(self, cheapest):
        """Return (K,) the least sum over the other routes of a solution that has one of each layer."""
        others = self.counts - np.eye(len(self.counts), dtype=int)
        return np.array([_total(cheapest, counts, self.least - 1) for counts in others])


def _total(cheapest, counts, least):
    each = np.sort(np.repeat(cheapest, counts))
    if least > len(each):
        return np.inf
    return float(each[: max(least, int((each < 0.0).sum()))].sum())
