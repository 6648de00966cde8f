"""Route enumeration: all elementary routes that a solution within the limit may use, from the labels of `labels`."""

import numpy as np
from scipy import sparse

from . import labels as lab
from .completions import completions_of
from .sets import to_marks


class Enumeration:
    """All labels that can be completed to routes of a solution of value at most `limit`, at the prices of every one of
    the evaluations, grown from the depot over the arcs of their network.

    whole: whether each route serves all targets; longest: visits that long routes make. complete: False if it needed
    more than `most` labels or `budget` extensions, or more time than the clock has left; it then proves nothing.
    One column for each closed route: visited (J, W); agents (J,) its layer of the graph; cost (J,) lower bound on its
    length. depth, label: (J,) where it ends.
    """

    def __init__(self, evaluations, limit, whole, longest, most, budget, clock):
        self.pieces, self.n = evaluations[0].pieces, len(evaluations[0].pi)
        self.complete, self.layers, self.links = True, [], []
        self._grow(evaluations, limit, longest, most, budget, clock)
        if self.complete:
            self._collect(evaluations, limit, whole)

    @property
    def size(self):
        return sum(len(layer.left) for layer in self.layers)

    def _grow(self, evaluations, limit, longest, most, budget, clock):
        """Extend all labels of one number of visits after the other.

        Most labels are half way along the longest routes, few at their ends: if more of the budget is gone than the
        share of the work that is done by then in most enumerations, it will not last.
        """
        completions, arcs, spent = completions_of(evaluations, limit), evaluations[0].arcs, 0
        self.layers.append(lab.first_labels(evaluations, limit))
        while len(self.layers) < self.n and len(self.layers[-1].left):
            share = min(len(self.layers) / longest, 1.0)
            due = budget * share**2 * (3.0 - 2.0 * share)
            spent += int(np.diff(arcs.start)[self.layers[-1].piece].sum())
            room, self.complete = max(float(most - self.size), 0.0), spent <= due
            if self.complete:
                layer, links, self.complete = lab.extend(
                    self.layers[-1], self.pieces, arcs, completions, room, clock.out
                )
            if not self.complete:
                return
            self.layers.append(layer)
            self.links.append(links)

    def _collect(self, evaluations, limit, whole):
        """Gather the closed routes of all layers as columns; whole: only those that serve all targets."""
        found = []
        for s, layer in enumerate(self.layers, start=1):
            if whole and s < self.n:
                continue
            reduced = lab.closings(layer, self.pieces)
            hits = np.flatnonzero(reduced < np.inf)
            found.append(self._within(evaluations, limit, s, layer, hits, reduced[hits]))
        if not found:
            none = np.zeros(0, int)
            found = [(none, none, self.layers[0].visited[:0], none, np.zeros(0))]
        self.depth, self.label, self.visited, self.agents, self.cost = map(np.concatenate, zip(*found))
        self.members = membership(self.visited, self.n)

    def _within(self, evaluations, limit, depth, layer, labels, reduced):
        """Return (depth, label, visited, agents, cost) of the labels whose routes stay within the limit, by what they
        cost at each of the prices."""
        visited, agents = layer.visited[labels], self.pieces.layer[layer.piece[labels]]
        members = membership(visited, self.n)
        paid = [members.T @ e.pi + e.cuts.price_of(members) for e in evaluations]
        cost = reduced + paid[0]
        kept = np.all([cost - own <= e.slack(limit)[agents] for e, own in zip(evaluations, paid)], axis=0)
        return np.full(kept.sum(), depth), labels[kept], visited[kept], agents[kept], cost[kept]

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

    def lead(self, alive):
        """Keep only the columns marked `alive` (J,), and the labels that lead to them, themselves or through what
        dominates them."""
        self.leads = [None] * len(self.layers)
        for s in range(len(self.layers), 0, -1):
            here = np.zeros(len(self.layers[s - 1].left), dtype=bool)
            here[self.label[alive & (self.depth == s)]] = True
            if s < len(self.layers):
                links = self.links[s - 1]
                links = links[self.leads[s][links[:, 1]]]
                here[links[:, 0]] = True
                self.links[s - 1] = links[np.argsort(links[:, 1], kind="stable")]  # by head, to walk back
            self.leads[s - 1] = here
        self.alive = alive

    def used_arcs(self, arcs):
        """Return (A,) which arcs lead to columns alive."""
        used = np.zeros(0, np.int64)
        for before, links, after in zip(self.layers, self.links, self.layers[1:]):
            used = np.union1d(used, self._pairs(before.piece[links[:, 0]], after.piece[links[:, 1]]))
        return np.isin(self._pairs(arcs.tail, arcs.head), used)

    def _pairs(self, tail, head):
        return tail.astype(np.int64) * len(self.pieces.a) + head

    def used_ends(self):
        """Return (starts, ends), each (Q,): the pieces where routes alive begin and end."""
        starts, ends = np.zeros((2, len(self.pieces.a)), dtype=bool)
        starts[self.layers[0].piece[self.leads[0]]] = True
        for s in np.unique(self.depth):
            ends[self.layers[s - 1].piece[self.label[self.alive & (self.depth == s)]]] = True
        return starts, ends

    def sequences(self, columns, most):
        """Return all sequences of segments along the labels that lead to some columns of one set, or None if there are
        more than `most`.

        Links lead dominated labels on to what dominates them, so the sequences of dominated labels are among these.
        """
        s = self.depth[columns[0]]
        states = _by_segment({(): self.label[columns]}, self.pieces.segment[self.layers[s - 1].piece])
        for before in range(s - 2, -1, -1):
            links = self.links[before]
            segment = self.pieces.segment[self.layers[before].piece]
            states = _by_segment({key: _tails(links, heads) for key, heads in states.items()}, segment)
            if len(states) > most:
                return None
        return list(states)


def membership(visited, n_targets):
    """Return the (n, J) sparse 0/1 matrix of targets by sets; visited: (J, W or more)."""
    column, target = np.nonzero(to_marks(visited, n_targets))
    starts = np.searchsorted(column, np.arange(len(visited) + 1))
    return sparse.csc_matrix((np.ones(len(target)), target, starts), shape=(n_targets, len(visited)))


def _tails(links, heads):
    """Return the labels that are linked to the labels `heads`; links are sorted by their heads."""
    start, end = np.searchsorted(links[:, 1], heads), np.searchsorted(links[:, 1], heads, side="right")
    return np.unique(np.concatenate([links[a:b, 0] for a, b in zip(start, end)]))


def _by_segment(states, segment):
    """Split the labels of each state by their segment, and put that before the state's sequence."""
    return {
        (int(i), *key): labels[segment[labels] == i]
        for key, labels in states.items()
        for i in np.unique(segment[labels])
    }
