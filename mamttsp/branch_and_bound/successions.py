"""Two edges in a row: an edge into a segment is flown only if one out of it is, in time and not back to where it came.

An edge e into a segment is followed by an edge out of it that can be left by when e arrives, and that does not lead
back to the target from which e comes. A tour that flies e flies one of these: y_e is at most their sum. The same holds
for the edges that come before an edge. With the times of a node of the search the sums are shorter, so the rows are
made anew at each node, and cut off more the deeper it is.
"""

import numpy as np

AFTER, BEFORE = 0, 1
#: s by which an edge may come too late and be followed all the same, far above what rounding does to times
_SLACK = 1e-6
#: the flow of an edge must exceed what can follow (or precede) it by this much to be worth a row
_VIOLATION = 0.02
#: a dual, of lengths in units of the instance's size, up to which a row does nothing; and for how many relaxations in a
#: row it may, each of which takes longer for it
_WEIGHT, _LONG = 1e-5, 10


class Successions:
    """The edges of which it is demanded, since a flow once violated it, that they be followed, or preceded."""

    def __init__(self, graph):
        self.graph = graph
        #: (2, |E|) of bool, by side: AFTER, BEFORE
        self.demanded = np.zeros((2, len(graph.edges)), dtype=bool)
        self._idle = np.zeros((2, len(graph.edges)), dtype=int)  # relaxations in a row that the row did nothing to

    def demand(self, y, alive, times):
        """Demand what the flow y (|E|,) on the edges in `alive` violates, with these times; tell whether it did."""
        found = False
        for side, demanded in enumerate(self.demanded):
            own = np.flatnonzero(alive & ~demanded & (y > _VIOLATION) & self._inner(side))
            short = own[y[own] - neighbours(self.graph, own, side, alive, times) @ y > _VIOLATION]
            demanded[short] = True
            self._idle[side, short] = 0
            found = found or len(short) > 0
        return found

    def rows(self, alive, times):
        """Return (number, row, edge, value): so many rows on the flow, by their entries, that are to be at most 0."""
        number, entries = 0, []
        for side, demanded in enumerate(self.demanded):
            own = np.flatnonzero(demanded & alive)
            row, edge = np.nonzero(neighbours(self.graph, own, side, alive, times))
            entries.append((number + np.arange(len(own)), own, np.ones(len(own))))
            entries.append((number + row, edge, -np.ones(len(row))))
            number += len(own)
        return number, *map(np.concatenate, zip(*entries))

    def weigh(self, alive, duals):
        """Take back the demands that did nothing for long, by the duals of the `rows` on the edges in `alive`."""
        held = self.demanded & alive
        self._idle[held] = np.where(duals > _WEIGHT, 0, self._idle[held] + 1)
        self.demanded &= self._idle < _LONG

    def _inner(self, side):
        """(|E|,) the edges that have a segment, no depot, on that side."""
        return self.graph.tau[self.graph.edges[:, 1 - side]] >= 0


def neighbours(graph, own, side, alive, times):
    """Return (len(own), |E|) of bool: which edges in `alive` can come right after (before) each of the edges `own`.

    times: (|E|, 4) of `propagate`.
    """
    tail, head = graph.edges.T
    each, other = own[:, None], np.flatnonzero(alive)[None, :]
    first, second = (each, other) if side == AFTER else (other, each)
    start, end = graph.tau[tail[first]], graph.tau[head[second]]
    fit = (head[first] == tail[second]) & (times[first, 2] <= times[second, 1] + _SLACK)
    found = np.zeros((len(own), len(alive)), dtype=bool)
    found[:, alive] = fit & ((start != end) | (start < 0))
    return found
