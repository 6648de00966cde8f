"""How much of a fractional flow comes from the depot, and the subtour cuts that it violates.

Maximum flow along shortest paths, in whole numbers, so exact, and compiled: a library's takes longer to be called, for
some twenty nodes, than to find it.
"""

import numpy as np

from ..compiled import compiled

#: the flow into a set must be short of 1 by this much to be worth a cut
_VIOLATION = 0.02
#: a flow of 1 in whole numbers
_ONE = 10**6


def violated_sets(graph, y):
    """Return sets S of targets (sorted tuples) with y(delta^-(S)) < 1; each target in any such set is in one."""
    found = set()
    for u, (share, S) in enumerate(depot_cuts(graph, y)):
        if share < 1.0 - _VIOLATION and not any(u in other for other in found):
            found.add(S)
    return sorted(found)


def depot_cuts(graph, y):
    """Yield (share, S) for each target: how much of its one visit the flow y (|E|,) can bring there from the depot.

    That is the least capacity y of a set of edges that cuts the target off, and S (a sorted tuple) are the targets cut
    off with it. Where the share is below 1, the rest goes round in cycles that never see the depot.
    """
    n = graph.n_targets
    first, second = graph.tau[graph.edges.T]  # s and s' are both -1, the last row and column
    capacity = np.zeros((n + 1, n + 1))
    np.add.at(capacity, (first, second), np.maximum(y, 0.0))
    capacity = np.rint(_ONE * capacity).astype(np.int64)
    for u in range(n):
        value, reached = _maximum_flow(capacity.copy(), n, u)
        yield value / _ONE, tuple(np.flatnonzero(~reached[:n]).tolist())


@compiled
def _maximum_flow(left, source, sink):
    """Return (value, reached): the flow from source to sink, and what the source still reaches beside it.

    left: (n, n) capacities, from which the flow is taken away.
    """
    n, value = len(left), 0
    queue, before = np.empty(n, dtype=np.int64), np.empty(n, dtype=np.int64)
    while True:
        reached = np.zeros(n, dtype=np.bool_)
        reached[source] = True
        queue[0], first, last = source, 0, 1
        while first < last and not reached[sink]:
            i = queue[first]
            first += 1
            for j in range(n):
                if left[i, j] > 0 and not reached[j]:
                    reached[j], before[j], queue[last] = True, i, j
                    last += 1
        if not reached[sink]:
            return value, reached
        more, j = left[before[sink], sink], sink
        while j != source:
            more, j = min(more, left[before[j], j]), before[j]
        j = sink
        while j != source:
            i = before[j]
            left[i, j] -= more
            left[j, i] += more
            j = i
        value += more
