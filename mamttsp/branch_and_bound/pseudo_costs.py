"""What branching on a pair of targets has done to the bound so far: pseudo-costs, which say where to branch next."""

import numpy as np

FLOWN, NOT_FLOWN = 0, 1
#: units; a rise of the bound that counts as none, so that the product of two still tells them apart
_LEAST = 1e-6


class PseudoCosts:
    """For each pair (one target, or the depot, is followed by another): rises of the bound, per unit of flow moved."""

    def __init__(self, graph):
        ends = graph.n_targets + 1  # s and s', -1 in tau, come last
        leaving, entering = graph.tau[graph.edges.T] % ends
        #: (|E|,) the pair of each edge
        self.pair = leaving * ends + entering
        self.rise, self.times = np.zeros((2, ends**2)), np.zeros((2, ends**2))

    def flow(self, y, alive):
        """Return the flow (pairs,) that y (|E|,) sends over the edges in `alive` of each pair."""
        return np.bincount(self.pair[alive], y[alive], minlength=self.rise.shape[1])

    def learn(self, side, pair, flow, rise):
        """Note that the bound rose by `rise` when a pair with this flow had to be FLOWN, or NOT_FLOWN."""
        self.rise[side, pair] += rise / (1.0 - flow if side == FLOWN else flow)
        self.times[side, pair] += 1

    def scores(self, flow):
        """Return (pairs,) the product of the rises expected either way, where the mean counts as seen once."""
        mean = self.rise.sum(axis=1) / np.maximum(self.times.sum(axis=1), 1.0)
        mean[mean == 0.0] = 1.0
        cost = (self.rise + mean[:, None]) / (self.times + 1.0)
        return np.maximum(cost[FLOWN] * (1.0 - flow), _LEAST) * np.maximum(cost[NOT_FLOWN] * flow, _LEAST)
