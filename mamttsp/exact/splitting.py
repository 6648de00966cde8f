"""Branching, where enumeration does not fit and shorter pieces do not help: on the number of agents, on which target
follows which, and on which type of agents serves a target."""

import dataclasses
from collections import Counter
from typing import NamedTuple

import numpy as np

from .evaluation import restricted


class Decision(NamedTuple):
    """Whether target w comes right after target u, or, with w = -1, whether agents of a layer of the graph serve u."""

    u: int
    w: int
    layer: int
    holds: bool

    def keeps(self, tail, head, layer):
        """Tell which legs, from target to target with -1 for the depot or the end, a decision permits; all arguments
        are arrays or numbers."""
        if self.w < 0:
            return ~(((tail == self.u) | (head == self.u)) & ((layer == self.layer) != self.holds))
        return ((tail == self.u) == (head == self.w)) if self.holds else ~((tail == self.u) & (head == self.w))

    def permits(self, route, layer):
        """Tell whether a route, a sequence of targets, has permitted legs only."""
        stops = np.r_[-1, route, -1]
        return bool(np.all(self.keeps(stops[:-1], stops[1:], layer)))

    def within(self, network):
        """Return the Network with its permitted legs."""
        pieces, arcs, depot = network.pieces, network.arcs, np.full(len(network.starts), -1)
        target, layer = pieces.target, pieces.layer
        alive = self.keeps(target[arcs.tail], target[arcs.head], layer[arcs.tail])
        starts = network.starts & self.keeps(depot, target, layer)
        return restricted(network, alive, starts, network.ends & self.keeps(target, depot, layer))


def fleets(support, fleet, whole):
    """Return two Fleets of alike agents, one of fewer and one of more routes than the fraction that the support has;
    none if there is no such fraction, or it is as close as `whole` to a whole number. support: (route, level, layer) of
    each."""
    total = sum(level for _, level, _ in support)
    few = int(total)
    if len(fleet.counts) > 1 or few < 1 or not whole < total - few < 1.0 - whole:
        return []
    return [
        dataclasses.replace(fleet, counts=np.minimum(fleet.counts, few)), dataclasses.replace(fleet, least=few + 1)
    ]  # fmt: skip


def decisions(support, whole):
    """Return the Decision that the support is most divided about, and its opposite; none if it is of one mind: all
    levels are as close as `whole` to 0 or 1."""
    flow = Counter()
    for route, level, layer in support:
        for u, w in zip(route, route[1:]):
            flow[int(u), int(w), -1] += level
        for u in route:
            flow[int(u), -1, layer] += level
    undecided = {key: abs(level - 0.5) for key, level in flow.items() if whole < level < 1.0 - whole}
    if not undecided:
        return []
    key = min(undecided, key=undecided.get)
    return [Decision(*key, True), Decision(*key, False)]
