"""Lagrangian bound: 'each target once' goes into the objective with multipliers pi, raised by subgradient steps.

With at most m relaxed routes of n visits in all, L(pi) = sum(pi) + (least total reduced cost of such routes) is a lower
bound for every pi. Fixing the total number of visits keeps the bound strong for one agent, where it is one route of n.
"""

import numpy as np

from . import relaxed


def combine(cost, n_agents):
    """Return (total, choice), each (m + 1, n + 1): least cost of at most j routes with t visits in all, and the number of
    visits of the last route in it. cost: (n + 1,) least reduced cost of a route by number of visits.
    """
    n = len(cost) - 1
    total = np.full((n_agents + 1, n + 1), np.inf)
    choice = np.zeros((n_agents + 1, n + 1), dtype=int)
    total[0, 0] = 0.0
    for j in range(1, n_agents + 1):
        total[j] = total[j - 1]
        for t in range(1, n + 1):
            candidates = total[j - 1, t - 1 :: -1] + cost[1 : t + 1]  # routes of 1..t visits
            best = int(np.argmin(candidates))
            if candidates[best] < total[j, t]:
                total[j, t], choice[j, t] = candidates[best], best + 1
    return total, choice


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
        """Return (bound, visits): L(pi), and how often its relaxed routes visit each target (n,), None if there are none."""
        relaxed.backward(self.pieces, pi, self.move, self.before, self.value, self.best, self.count, self.index)
        self.cost, self.start = relaxed.cheapest_routes(self.pieces, pi, self.value, self.count, self.index)
        self.total, self.choice = combine(self.cost, self.m)
        if np.isinf(self.total[self.m, self.n]):
            return np.inf, None
        return float(pi.sum() + self.total[self.m, self.n]), self._visits()

    def _visits(self):
        visits = np.zeros(self.n)
        t = self.n
        for j in range(self.m, 0, -1):
            if length := self.choice[j, t]:
                np.add.at(visits, self.pieces.target[self._trace(length)], 1)
                t -= length
        return visits

    def _trace(self, length):
        q, mask = self.start[length]
        route = [q]
        for k in range(length - 1, 0, -1):
            q, mask = self.best[k, q, mask]
            route.append(q)
        return route

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


def ascend(relaxation, pi, upper, iterations, out_of_time):
    """Raise L(pi) by Polyak steps towards `upper`; return (best bound, its pi) and leave the tables evaluated there."""
    best_bound, best_pi, direction = -np.inf, pi, 0.0
    scale, stalled = 1.0, 0
    for _ in range(iterations):
        bound, visits = relaxation.evaluate(pi)
        if visits is None:
            return np.inf, pi
        stalled = 0 if bound > best_bound + 1e-4 * abs(best_bound) else stalled + 1
        if bound > best_bound:
            best_bound, best_pi = bound, pi
        if stalled >= 4:
            scale, stalled, pi = 0.6 * scale, 0, best_pi
        violation = 1.0 - visits
        if not violation.any() or bound >= upper or out_of_time():
            break
        direction = violation + 0.3 * direction
        pi = pi + scale * (upper - bound) / (direction @ direction) * direction
    if pi is not best_pi:
        relaxation.evaluate(best_pi)
    return best_bound, best_pi
