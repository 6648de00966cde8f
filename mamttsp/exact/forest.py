"""The forest of labels, layer by layer, and the routes that it closes."""

import numpy as np

from . import labels as lab
from . import relaxed
from .layer import select
from .settle import members


class Forest:
    """All labels whose completion bound is at most `limit`, grown from the depot over the pieces of a relaxation.

    complete: False if it needed more than `most` labels; it then proves nothing. With `beam`, only that many labels of
    each layer are kept, those of least bound: a heuristic, which proves nothing either.
    Columns, one for each closed route: visited (J,) uint64, cost (J,) length bound, bound (J,) least value of a
    solution with it; both without multipliers.
    """

    def __init__(self, relaxation, pi, limit, most, budget=np.inf, beam=None, out_of_time=lambda: False):
        self.pieces, self.n, self.complete = relaxation.pieces, relaxation.n, True
        self._relaxation, self._pi, self._constant = relaxation, pi, pi.sum()
        self._limit = limit - self._constant
        to_go = relaxation.completions()
        self._completion = relaxed.completions_with_rest(to_go, relaxation.rest)
        self._grow(most, budget, beam, out_of_time)
        if self.complete:
            self._collect()

    @property
    def size(self):
        return sum(len(layer.left) for layer in self.layers)

    def _grow(self, most, budget, beam, out_of_time):
        relaxation, pieces = self._relaxation, self.pieces
        common = (pieces, self._pi, relaxation.N, self._completion, relaxation.after, self._limit)
        layer = lab.first_labels(*common)
        self.layers, self.links = [layer], []
        for s in range(1, self.n):
            if beam and len(layer.left) > beam:
                layer = select(layer, np.sort(np.argpartition(layer.bound, beam)[:beam]))
                self.layers[-1] = layer
            room = max(float(most - self.size), 0.0)  # always a float, or it is compiled twice
            layer, links, self.complete = lab.extend(layer, s, *common, room, budget)
            if not self.complete or out_of_time():
                self.complete = False
                return
            self.layers.append(layer)
            self.links.append(links)
            budget -= len(layer.left) * len(pieces.a)

    def _collect(self):
        """Gather the closed routes of all layers as columns."""
        found = []
        for s, layer in enumerate(self.layers, start=1):
            bound, cost = lab.closings(layer, self.pieces, self._relaxation.rest[self.n - s])
            hits = np.flatnonzero((bound <= self._limit) & (bound < np.inf))
            found.append((np.full(len(hits), s), hits, layer.visited[hits], cost[hits], bound[hits]))
        self.depth, self.label, self.visited, cost, bound = (np.concatenate(part) for part in zip(*found))
        self.members = members(self.visited, self.n)
        self.cost = cost + self.members.T @ self._pi
        self.bound = bound + self._constant

    def route(self, column):
        """Return the pieces of a column's route, in the order of its visits."""
        x, route = self.label[column], []
        for layer in reversed(self.layers[: self.depth[column]]):
            route.append(layer.piece[x])
            x = layer.parent[x]
        return route[::-1]

    def segments(self, column):
        """Return the segments of a column's route, a tuple of nodes of the graph in the order of its visits."""
        return tuple(int(i) for i in self.pieces.segment[self.route(column)])

    def leading(self, alive):
        """Return, layer by layer, which labels lead to a column marked `alive` (J,), themselves or through what
        dominates them."""
        leads = [None] * self.n
        for s in range(self.n, 0, -1):
            here = np.zeros(len(self.layers[s - 1].left), dtype=bool)
            here[self.label[alive & (self.depth == s)]] = True
            if s < self.n:
                links = self.links[s - 1]
                here[links[leads[s][links[:, 1]], 0]] = True
            leads[s - 1] = here
        return leads

    def used_pieces(self, leads):
        """Return (after, before): the (s, q) and (k, q) of the labels in `leads`."""
        after, before = np.zeros_like(self._relaxation.after), np.zeros_like(self._relaxation.before)
        for s, (layer, lead) in enumerate(zip(self.layers, leads), start=1):
            after[s, layer.piece[lead]] = True
        # With several agents the routes through (s, q) may have any number of visits to come.
        for s in range(1, self.n + 1):
            for k in range(self.n - s + 1):
                if np.isfinite(self._relaxation.rest[self.n - s - k]):
                    before[k] |= after[s]
        return after, before & self._relaxation.before

    def sequences(self, leads, most):
        """Return all sequences of n segments along the labels in `leads`, or None if there are more than `most`.

        Links lead dominated labels on to what dominates them, so the sequences of dominated labels are among these.
        """
        segment = [self.pieces.segment[layer.piece] for layer in self.layers]
        states = _by_segment({(): np.flatnonzero(leads[0])}, segment[0])
        for s in range(1, self.n):
            links = self.links[s - 1]
            links = links[leads[s - 1][links[:, 0]] & leads[s][links[:, 1]]]
            links = links[np.argsort(links[:, 0], kind="stable")]
            states = _by_segment({key: _heads(links, tails) for key, tails in states.items()}, segment[s])
            if len(states) > most:
                return None
        return list(states)


def _heads(links, tails):
    """Return the labels that the labels `tails` are linked to; links are sorted by their tails."""
    start, end = np.searchsorted(links[:, 0], tails), np.searchsorted(links[:, 0], tails, side="right")
    return np.unique(np.concatenate([links[a:b, 1] for a, b in zip(start, end)]))


def _by_segment(states, segment):
    """Split the labels of each state by their segment, and add that to the state's sequence."""
    return {
        (*key, int(i)): labels[segment[labels] == i]
        for key, labels in states.items()
        for i in np.unique(segment[labels])
    }
