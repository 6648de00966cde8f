"""Where the search for the MICP branches: does one target follow another? And then: on which edge?"""

from typing import NamedTuple

import numpy as np

_TOLERANCE = 1e-6


class Children(NamedTuple):
    """flown, other: two sets of edges (|E|,) that share out all choices; pair, flow: the pair of targets of which one
    follows the other in the first and not in the second, and its flow, None if the two differ by an edge."""

    flown: np.ndarray
    other: np.ndarray
    pair: int | None = None
    flow: float | None = None


def branch(graph, y, alive, costs):
    """Return the Children of a node with the flow y (|E|,) on the edges in `alive`; None if one choice is left.

    Of the pairs with fractional flow the one is taken that the PseudoCosts `costs` promise most of. Once all pairs are
    whole, the fractional edge with the most flow is.
    """
    flow = costs.flow(y, alive)
    fractional = (flow > _TOLERANCE) & (flow < 1.0 - _TOLERANCE)
    if fractional.any():
        pair = int(np.where(fractional, costs.scores(flow), -1.0).argmax())
        return Children(*_shared_out(graph, alive, costs.pair == pair), pair, flow[pair])
    edge = _edge(graph, y, alive)
    return None if edge is None else Children(*_shared_out(graph, alive, np.arange(len(alive)) == edge))


def _shared_out(graph, alive, chosen):
    return alive & ~_rivals(graph, chosen), alive & ~chosen


def _rivals(graph, chosen):
    """Return the edges that cannot be flown if one of `chosen`, all from one target to one other, is."""
    rivals = np.zeros(len(chosen), dtype=bool)
    for target in graph.tau[graph.edges.T]:
        shared = target[chosen][0]
        if shared >= 0:  # any number of edges may leave s and enter s'
            rivals |= target == shared
    return rivals & ~chosen


def _edge(graph, y, alive):
    """Return the edge with the most fractional flow among those with rivals; if none is fractional, one with flow."""
    contested = np.zeros(len(alive), dtype=bool)
    for target in graph.tau[graph.edges.T]:
        held = alive & (target >= 0)
        contested[held] |= np.bincount(target[held])[target[held]] > 1
    if not contested.any():
        return None
    weight = np.where(contested, y, -1.0)
    fractional = np.where(y < 1.0 - _TOLERANCE, weight, -1.0)
    return fractional.argmax() if fractional.max() > _TOLERANCE else weight.argmax()
