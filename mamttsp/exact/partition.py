"""Set partitioning: choose at most m routes that serve each target once, at least total cost (HiGHS through scipy)."""

import numpy as np
from scipy import optimize, sparse

#: more columns than this are thinned by their reduced costs first
_FEW = 5000


def choose(members, cost, n_agents, limit=np.inf, time_limit=None):
    """Return (bound, chosen): a proved lower bound on the best choice, and its columns, None if there is none.

    members: (n, J) sparse 0/1 matrix, targets by columns; cost: (J,). Columns that can only lead to more than `limit`
    may be left out, so a bound is at most `limit`.
    """
    n, J = members.shape
    left_out = np.inf
    keep = np.arange(J)
    if J > _FEW and np.isfinite(limit):
        keep, left_out = _thin(members, cost, n_agents, limit)
        if not len(keep):
            return left_out, None
    rows = sparse.vstack([members[:, keep], sparse.csr_matrix(np.ones((1, len(keep))))], format="csc")
    rule = optimize.LinearConstraint(rows, np.r_[np.ones(n), 0.0], np.r_[np.ones(n), n_agents])
    options = {"mip_rel_gap": 1e-9, **({} if time_limit is None else {"time_limit": max(time_limit, 0.01)})}
    answer = optimize.milp(cost[keep], constraints=rule, integrality=1, bounds=optimize.Bounds(0, 1), options=options)
    if answer.status == 2:
        return left_out, None
    bound = -np.inf if answer.mip_dual_bound is None else answer.mip_dual_bound
    chosen = None if answer.x is None else keep[np.flatnonzero(answer.x > 0.5)]
    return min(bound, left_out), chosen


def _thin(members, cost, n_agents, limit):
    """Return (kept columns, least value with any other): leave out what the LP's reduced costs put beyond `limit`."""
    n, J = members.shape
    answer = optimize.linprog(
        cost, A_ub=sparse.csr_matrix(np.ones((1, J))), b_ub=[n_agents], A_eq=members, b_eq=np.ones(n), bounds=(0, None)
    )
    if answer.status == 2:
        return np.array([], dtype=int), np.inf
    if answer.status != 0:
        return np.arange(J), np.inf
    dual, fleet = answer.eqlin.marginals, min(answer.ineqlin.marginals[0], 0.0)
    reduced = cost - members.T @ dual - fleet
    # Any duals with fleet <= 0 give a bound: sum(dual) + m * fleet + the negative reduced costs, of at most m columns.
    base = dual.sum() + n_agents * fleet + n_agents * min(reduced.min(), 0.0)
    keep = np.flatnonzero(base + reduced <= limit)
    return keep, limit if len(keep) < J else np.inf
