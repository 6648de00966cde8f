"""Lagrangian bound: 'each target once' goes into the objective with multipliers pi, raised by column generation.

With at most m relaxed routes of n visits in all, L(pi) = sum(pi) + (least total reduced cost of such routes) is a lower
bound for every pi. Fixing the total number of visits keeps the bound strong for one agent, where it is one route of n.
"""

import numpy as np
from scipy import optimize

from . import relaxed

#: weight of the best multipliers so far against those of the master problem (Wentges smoothing)
_SMOOTHING = 0.7
#: columns added in a round, and kept in the master
_NEW, _KEPT = 60, 600
#: column generation ends when the bound is within this share of the master's value
_CONVERGED = 1e-3


def combine(cost, n_agents):
    """Return (m + 1, n + 1): the least cost of at most j routes with t visits in all. cost: (n + 1,) by number of
    visits."""
    n = len(cost) - 1
    total = np.full((n_agents + 1, n + 1), np.inf)
    total[0, 0] = 0.0
    for j in range(1, n_agents + 1):
        total[j] = total[j - 1]
        for t in range(1, n + 1):
            total[j, t] = min(total[j, t], np.min(total[j - 1, t - 1 :: -1] + cost[1 : t + 1]))
    return total


class Relaxation:
    """The relaxed routes over one set of pieces, with the buffers of their dynamic programs.

    after: (n + 1, Q), before: (n, Q): which pieces may come after s visits, and before k more, in a better solution.
    """

    def __init__(self, pieces, n_targets, n_agents, N, move, after, before):
        self.pieces, self.n, self.m, self.N, self.move = pieces, n_targets, n_agents, N, move
        self.after, self.before = after, before
        shape = (n_targets, len(pieces.a), 1 << N.shape[1])
        self.value = np.empty((*shape, 2))
        self.best = np.empty((*shape, 2), dtype=np.int32)
        self.count = np.empty(shape[:2], dtype=np.int32)
        self.index = np.empty(shape, dtype=np.int32)

    def evaluate(self, pi):
        """Return L(pi), infinite if there are no relaxed solutions, and leave the tables of values to go."""
        relaxed.backward(self.pieces, pi, self.move, self.before, self.value, self.best, self.count, self.index)
        self.cost, self.start = relaxed.cheapest_routes(self.pieces, pi, self.value, self.count, self.index, self.n)
        self.total = combine(np.r_[np.inf, self.cost.min(axis=1)], self.m)
        return float(pi.sum() + self.total[self.m, self.n])

    def columns(self, pi):
        """Return (visits (J, n), cost (J,)): cheap relaxed routes, how often they visit each target, and their
        lengths."""
        reduced = self.cost if self.m > 1 else self.cost[-1:]  # one agent makes all n visits
        lengths, firsts = np.nonzero(reduced < np.inf)
        cheapest = np.argsort(reduced[lengths, firsts], kind="stable")[:_NEW]
        lengths, firsts = lengths[cheapest] + self.n - len(reduced), firsts[cheapest]
        visits = relaxed.trace(self.pieces, self.best, self.start, lengths, firsts, self.n)
        return visits, self.cost[lengths, firsts] + visits @ pi

    @property
    def rest(self):
        """(n + 1,) least reduced cost of the other m - 1 agents' routes, by their number of visits."""
        return self.total[self.m - 1]

    def completions(self):
        """Return the values to go by what they may not repeat; see `relaxed.completions`."""
        return relaxed.completions(self.value, self.N.shape[1])

    def eliminate(self, pi, limit):
        """Keep alive only what lies on a relaxed solution of value at most `limit` (sum of pi included)."""
        shape = (self.n + 1, *self.value.shape[1:])
        so_far = np.empty(shape)
        count, index = np.empty(shape[:2], dtype=np.int32), np.empty(shape[:3], dtype=np.int32)
        relaxed.forward(self.pieces, pi, self.move, self.after, so_far, count, index)
        self.after, self.before = relaxed.still_alive(
            so_far, count, index, self.completions(), self.rest, limit - pi.sum()
        )


def ascend(relaxation, pi, known, iterations, out_of_time):
    """Raise L(pi) by column generation; return (best bound, its pi) and, if time is left, leave the tables
    evaluated there.

    known: (visits (J, n), cost (J,)) of columns with which the master problem has a solution.
    """
    visits, cost = known
    best_bound, best_pi = -np.inf, pi
    for iteration in range(iterations):
        bound = relaxation.evaluate(pi)
        if np.isinf(bound):
            return bound, pi
        if bound > best_bound:
            best_bound, best_pi = bound, pi
        if iteration == iterations - 1:
            break
        more_visits, more_cost = relaxation.columns(pi)
        visits, cost = np.vstack([visits, more_visits]), np.r_[cost, more_cost]
        value, dual, reduced = _master(visits, cost, relaxation.m)
        if value - best_bound <= _CONVERGED * abs(best_bound) or out_of_time():
            break
        keep = np.argsort(reduced, kind="stable")[:_KEPT]
        visits, cost = visits[keep], cost[keep]
        pi = _SMOOTHING * best_pi + (1.0 - _SMOOTHING) * dual
    if pi is not best_pi and not out_of_time():
        relaxation.evaluate(best_pi)
    return best_bound, best_pi


def _master(visits, cost, n_agents):
    """Return (value, dual (n,), reduced costs (J,)) of the linear set partitioning over the columns."""
    answer = optimize.linprog(
        cost,
        A_eq=visits.T,
        b_eq=np.ones(visits.shape[1]),
        A_ub=np.ones((1, len(cost))),
        b_ub=[n_agents],
        method="highs",
    )
    dual, fleet = answer.eqlin.marginals, answer.ineqlin.marginals[0]
    return answer.fun, dual, cost - visits @ dual - fleet
