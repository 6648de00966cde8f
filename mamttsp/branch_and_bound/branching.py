"""Where the search for the MICP branches: does one target follow another? And then: on which edge?"""

import numpy as np

_TOLERANCE = 1e-6


def branch(graph, y, alive):
    """Return two sets of edges (|E|,), parts of `alive`, that share out all choices; None if one choice is left.

    In the first set some target, or the depot, is followed by some other one; in the second it is not. The pair whose
    flow in y is nearest to one half is taken: it changes most either way. Once all pairs are whole, the fractional edge
    with the most flow is.
    """
    leaving, entering = graph.tau[graph.edges.T] % (graph.n_targets + 1)  # s and s', -1 in tau, come last
    pair = leaving * (graph.n_targets + 1) + entering
    distance = np.abs(np.bincount(pair[alive], y[alive], minlength=1) - 0.5)
    if distance.min() < 0.5 - _TOLERANCE:
        chosen = pair == distance.argmin()
    elif (edge := _edge(graph, y, alive)) is not None:
        chosen = np.arange(len(alive)) == edge
    else:
        return None
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
