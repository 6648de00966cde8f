"""Set partitioning: choose at most m routes that serve each target once, at least total cost (HiGHS through scipy)."""

from typing import NamedTuple

import numpy as np
from scipy import optimize, sparse


class Relaxed(NamedTuple):
    """The linear relaxation. bound: proved lower bound on every choice, infinite if there is none; support: columns
    at a positive level; dual: (n,) prices of the targets; slack: (J,) by how much each column's cost may grow before
    every choice with it costs more than the limit (negative: it does already).
    """

    bound: float
    support: np.ndarray
    dual: np.ndarray
    slack: np.ndarray


def relax_choice(members, cost, n_agents, limit):
    """Return the Relaxed choice of columns; members: (n, J) sparse 0/1 matrix, targets by columns; cost: (J,). With one
    agent all columns have to be whole tours.

    Whatever the prices with a fleet price <= 0, a choice with column j costs at least
    sum(dual) + m * fleet + reduced cost of j + (m - 1) * (the least reduced cost, if negative).
    """
    n, J = members.shape
    none = np.zeros(0, dtype=int)
    if J == 0:
        return Relaxed(np.inf, none, np.zeros(n), np.zeros(0))
    if n_agents == 1:  # every column serves all targets
        cheapest = np.argmin(cost)
        return Relaxed(cost[cheapest], np.array([cheapest]), np.zeros(n), limit - cost)
    fleet_row = sparse.csr_matrix(np.ones((1, J)))
    answer = optimize.linprog(
        cost, A_ub=fleet_row, b_ub=[n_agents], A_eq=members, b_eq=np.ones(n), bounds=(0, None), method="highs"
    )
    if answer.status == 2:
        return Relaxed(np.inf, none, np.zeros(n), np.full(J, -np.inf))
    dual, fleet = answer.eqlin.marginals, min(answer.ineqlin.marginals[0], 0.0)
    reduced = cost - members.T @ dual - fleet
    least = min(reduced.min(), 0.0)
    base = dual.sum() + n_agents * fleet
    slack = limit - (base + (n_agents - 1) * least + reduced)
    return Relaxed(base + n_agents * least, np.flatnonzero(answer.x > 1e-7), dual, slack)


def choose(members, cost, n_agents, time_limit=None):
    """Return (bound, chosen): a proved lower bound on the cost of every choice, infinite if there is none, and the
    columns of a best one found, None without."""
    n, J = members.shape
    if J == 0:
        return np.inf, None
    if n_agents == 1:
        return np.min(cost), np.array([np.argmin(cost)])
    rows = sparse.vstack([members, sparse.csr_matrix(np.ones((1, J)))], format="csc")
    rule = optimize.LinearConstraint(rows, np.r_[np.ones(n), 0.0], np.r_[np.ones(n), n_agents])
    options = {"mip_rel_gap": 1e-9}
    if time_limit is not None:
        options["time_limit"] = max(time_limit, 0.01)
    answer = optimize.milp(cost, constraints=rule, integrality=1, bounds=optimize.Bounds(0, 1), options=options)
    if answer.status == 2:
        return np.inf, None
    bound = -np.inf if answer.mip_dual_bound is None else answer.mip_dual_bound
    return bound, None if answer.x is None else np.flatnonzero(answer.x > 0.5)
