"""Set partitioning: choose routes, no more than the fleet permits, that serve each target once, at least total cost
(HiGHS)."""

import time
from typing import NamedTuple

import highspy
import numpy as np
from scipy import sparse

from ..silent_highs import SilentHighs
from .cuts import separate

#: HiGHS's answers hold to within its tolerances, 1e-9 of what costs are counted in for each row
_ACCURACY = 1e-8
#: and they are counted in no less than this share of the size of the area
_LEAST_SCALE = 1e-4


class Relaxed(NamedTuple):
    """The linear relaxation. bound: proved lower bound on every choice; support: columns at a positive level; dual:
    (n,) prices of the targets; slack: (J,) by how much each column's cost may grow before every choice with it costs
    more than the limit (negative: it does already); rows: (C, n) bool, the subset-row cuts.
    """

    bound: float
    support: np.ndarray
    dual: np.ndarray
    slack: np.ndarray
    rows: np.ndarray


def relax_choice(members, agents, cost, fleet, limit, unit, parameters, time_limit=np.inf, rows=None):
    """Return the Relaxed choice of columns, None if there was no time; members: (n, J) sparse 0/1 matrix, targets by
    columns; agents: (J,) layer of the graph of each; cost: (J,); fleet: a Fleet; limit: choices that cost more are of
    no interest; rows: (C, n) subset-row cuts to begin with, see `cuts`.

    Violated cuts are added until there is none: all columns are known, so their prices do no harm. Columns that cannot
    be in a choice below the limit are dropped between.
    """
    p, (n, J) = parameters, members.shape
    rows = np.zeros((0, n), bool) if rows is None else rows
    best, alive, slack, end = None, np.arange(J), np.full(J, np.inf), time.monotonic() + time_limit
    unit = _scale(limit, unit)
    while True:
        left = end - time.monotonic()
        found = _relax(members[:, alive], agents[alive], cost[alive], fleet, limit, unit, left, rows, p.choice_columns)
        if found is None:
            return best
        bound, support, level, dual, part = found
        slack[alive] = np.minimum(slack[alive], part)
        bound = bound if len(alive) == J else min(bound, limit)  # more is not proved without those dropped
        best = Relaxed(bound if best is None else max(bound, best.bound), alive[support], dual, slack.copy(), rows)
        if bound >= limit or len(alive) > p.choice_few or len(rows) >= p.choice_most_cuts:
            return best
        routes = [members.indices[members.indptr[j] : members.indptr[j + 1]] for j in alive[support]]
        more, _ = separate(routes, level, n, p.choice_cuts, p.violation)
        if not len(more):
            return best
        rows, kept = np.vstack([rows, more]), part >= 0.0
        kept[support] = True
        alive = alive[kept]


def _relax(members, agents, cost, fleet, limit, unit, time_limit, rows, few):
    """Return (bound, support, its levels, dual, slack) of the linear relaxation with the cuts `rows`, or None.

    The linear program begins with `few` columns, and takes in as many of negative reduced cost until there is none.
    Whatever the prices, a choice with column j costs at least their sum + reduced cost of j + (what the other columns
    must cost, at the least reduced cost of each layer).
    """
    n, K, C = members.shape[0], len(fleet.counts), len(rows)
    each = cost / np.diff(members.indptr)  # for each target served
    active = np.argsort(each, kind="stable")[:few]
    paid = sparse.csr_matrix(rows.astype(float)) @ members
    paid.data //= 2.0
    while True:
        highs = _model(
            members[:, active], agents[active], cost[active], fleet, limit, unit, time_limit, paid[:, active]
        )  # fmt: skip
        highs.run()
        if highs.getModelStatus() != highspy.HighsModelStatus.kOptimal:
            return None
        answer = highs.getSolution()
        dual = np.array(answer.row_dual) * unit
        sigma, dual = np.minimum(dual[len(dual) - C :], 0.0), dual[: len(dual) - C]
        reduced, price = cost - members.T @ dual[:n] - paid.T @ sigma, dual[n : n + K] + dual[n + K :].sum()
        more = np.setdiff1d(np.flatnonzero(reduced - price[agents] < -_ACCURACY * unit), active)
        if not len(more):
            break
        active = np.r_[active, more[np.argsort(reduced[more], kind="stable")[:few]]]
    cheapest = np.full(K, np.inf)
    np.minimum.at(cheapest, agents, reduced)
    base = dual[:n].sum() + sigma.sum()
    slack = limit - (base + fleet.rest(cheapest)[agents] + reduced)
    level = np.array(answer.col_value)[: len(active)]
    return base + fleet.total(cheapest), active[level > 1e-7], level[level > 1e-7], dual[:n], slack


def choose(members, agents, cost, fleet, limit, unit, time_limit=np.inf):
    """Return (bound, chosen): a proved lower bound on the cost of every choice, no more than the limit, and the columns
    of a best one found, None without one below the limit; arguments as in `relax_choice`."""
    J = members.shape[1]
    if J == 0:
        return limit, None
    unit = _scale(limit, unit)
    highs = _model(members, agents, cost, fleet, limit, unit, time_limit, sparse.csr_matrix((0, J)))
    highs.changeColsIntegrality(J, np.arange(J, dtype=np.int32), np.full(J, highspy.HighsVarType.kInteger))
    for name in ("mip_rel_gap", "mip_abs_gap"):
        highs.setOptionValue(name, 0.1 * _ACCURACY)
    highs.run()
    bound = highs.getInfo().mip_dual_bound
    bound = (bound - _ACCURACY) * unit if np.isfinite(bound) else -np.inf
    level = np.array(highs.getSolution().col_value)
    chosen = np.flatnonzero(level[:J] > 0.5) if len(level) else np.zeros(0, int)
    used = np.bincount(agents[chosen], minlength=len(fleet.counts))
    whole = (used <= fleet.counts).all() and (members[:, chosen].sum(axis=1) == 1.0).all()
    return min(bound, limit), chosen if whole and len(chosen) else None


def _scale(limit, unit):
    """Return what to count costs in: where the limit is far below the size of the area, so is a gap that counts."""
    return max(min(abs(limit), unit), _LEAST_SCALE * unit)


def _model(members, agents, cost, fleet, limit, unit, time_limit, paid):
    """Return HiGHS with the choice; a target may stay unserved at the price of more than the limit, so that there is
    always an answer. Rows: targets, layers, all routes where more than one is needed, and cuts: paid (C, J)."""
    n, J = members.shape
    K, needed = len(fleet.counts), [float(fleet.least)] if fleet.least > 1 else []
    of_layer = sparse.csr_matrix((np.ones(J), (agents, np.arange(J))), shape=(K, J))
    C = paid.shape[0]
    routes = sparse.vstack([members, of_layer, np.ones((len(needed), J)), paid])
    unserved = sparse.vstack(
        [sparse.eye(n), sparse.csr_matrix((K, n)), np.ones((len(needed), n)), sparse.csr_matrix((C, n))]
    )  # fmt: skip
    matrix = sparse.hstack([routes, unserved], format="csc")
    lp = highspy.HighsLp()
    lp.num_col_, lp.num_row_ = J + n, n + K + len(needed) + C
    lp.col_cost_ = np.r_[cost, np.full(n, 2.0 * abs(limit) + unit)] / unit
    lp.col_lower_, lp.col_upper_ = np.zeros(J + n), np.full(J + n, highspy.kHighsInf)
    lp.row_lower_ = np.r_[np.ones(n), np.full(K, -highspy.kHighsInf), needed, np.full(C, -highspy.kHighsInf)]
    lp.row_upper_ = np.r_[np.ones(n), fleet.counts, np.full(len(needed), highspy.kHighsInf), np.ones(C)]
    lp.a_matrix_.format_ = highspy.MatrixFormat.kColwise
    lp.a_matrix_.start_, lp.a_matrix_.index_, lp.a_matrix_.value_ = matrix.indptr, matrix.indices, matrix.data
    highs = SilentHighs()
    for name, value in (("output_flag", False), ("threads", 1), ("random_seed", 0)):
        highs.setOptionValue(name, value)
    for name in ("primal_feasibility_tolerance", "dual_feasibility_tolerance", "mip_feasibility_tolerance"):
        highs.setOptionValue(name, 0.1 * _ACCURACY)
    highs.setOptionValue("time_limit", max(min(time_limit, 1e9), 1e-3))
    highs.passModel(lp)
    return highs
