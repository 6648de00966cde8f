"""Sets of targets that a fractional flow enters less than once: the subtour cuts that it violates."""

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import breadth_first_order, maximum_flow

#: the flow into a set must be short of 1 by this much to be worth a cut
_VIOLATION = 0.02
#: capacities are whole numbers in units of this
_UNIT = 1e-6


def violated_sets(graph, y):
    """Return sets S of targets (sorted tuples) with y(delta^-(S)) < 1; each target in any such set is in one.

    By maximum flow and minimum cut, S is what the residual network of a flow from the depot cannot reach.
    """
    n = graph.n_targets
    first, second = graph.tau[graph.edges.T]  # s and s' are both -1, the last row and column
    capacity = np.zeros((n + 1, n + 1))
    np.add.at(capacity, (first, second), y)
    network = sparse.csr_array(np.rint(np.maximum(capacity, 0.0) / _UNIT).astype(np.int32))
    network.eliminate_zeros()
    found = set()
    for u in range(n):
        if any(u in S for S in found):
            continue
        flow = maximum_flow(network, n, u)
        if flow.flow_value < (1.0 - _VIOLATION) / _UNIT:
            reached = breadth_first_order(_positive(network - flow.flow), n, return_predecessors=False)
            found.add(tuple(np.setdiff1d(np.arange(n), reached).tolist()))
    return sorted(found)


def _positive(residual):
    residual = sparse.csr_array(residual)
    residual.eliminate_zeros()
    return residual
