"""Where the search for the MICP branches: on an edge, flown or not."""

import numpy as np

_WHOLE = 1.0 - 1e-6


def without_rivals(graph, alive, edge):
    """Return the edges left if `edge` is flown: no other one leaves its tail's target or enters its head's target."""
    (i, j), (tail, head) = graph.edges[edge], graph.edges.T
    rival = np.zeros(len(alive), dtype=bool)
    if i != graph.s:
        rival |= graph.tau[tail] == graph.tau[i]
    if j != graph.s_prime:
        rival |= graph.tau[head] == graph.tau[j]
    rival[edge] = False
    return alive & ~rival


def choose_edge(graph, y, alive):
    """Return the edge with the largest fractional flow among those that have rivals left, None if none has.

    If the flow is whole on all of them, any one with flow is taken: its numbers may still hide something.
    """
    contested = np.zeros(len(alive), dtype=bool)
    for target in graph.tau[graph.edges.T]:
        at_target = alive & (target >= 0)  # edges from s and to s' have no rivals there
        contested[at_target] |= np.bincount(target[at_target])[target[at_target]] > 1
    candidates = np.flatnonzero(contested)
    if not len(candidates):
        return None
    fractional = candidates[y[candidates] < _WHOLE]
    candidates = fractional if y[fractional].max(initial=0.0) > 1 - _WHOLE else candidates
    return candidates[np.argmax(y[candidates])]
