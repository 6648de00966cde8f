"""Time prices: what the fixed-order SOCP says a second is worth at each visit, and what they make of relaxed times.

A relaxed route may arrive at a visit at one time, t', and leave it at another, t. A price mu_j on each visit's
t'_j - t_j adds mu_j t'_j - mu_i t_i to the leg from i to j; for real times these terms cancel, so whatever the prices,
the cheapest relaxed times are a lower bound on the route's length. By strong duality some prices make both equal. The
exact solver never calls this module: its values, affine in time, find their own prices. It is there to look at them.
"""

import cvxpy as cp
import numpy as np


def time_prices(graph, route):
    """Return (length, times, mu), each visit's (K,) time in s and price in units/s, of a route of K segments in order.

    mu: the dual of t'_j = t_j in the SOCP of the route. ValueError if the route cannot be flown.
    """
    program = _Program(graph, route, graph.t_lo[route], graph.t_hi[route])
    meet = program.arrive == program.leave
    length = program.minimise(0.0, [meet])
    return length, program.leave.value, np.array(meet.dual_value)


def relaxed_times(graph, route, mu, start=None, end=None):
    """Return (bound, arrive, leave), the latter (K,) in s: the least priced length when a visit's times may differ.

    mu: (K,) prices; start, end: (K,) where both times of a visit have to be, in s; the whole segment without.
    """
    start = graph.t_lo[route] if start is None else start
    end = graph.t_hi[route] if end is None else end
    program = _Program(graph, route, start, end)
    bound = program.minimise(np.asarray(mu) @ (program.arrive - program.leave), [])
    return bound, program.arrive.value, program.leave.value


def pinned_lengths(graph, route, k, times):
    """Return (so_far, to_go), both (len(times),): the shortest way to visit k of a route if it is at that time, and on
    from it; infinite where it cannot be flown."""
    so_far, to_go = np.full(len(times), np.inf), np.full(len(times), np.inf)
    for x, t in enumerate(times):
        start, end = graph.t_lo[route], graph.t_hi[route]
        start[k] = end[k] = t
        program = _Program(graph, route, start, end)
        try:
            program.minimise(0.0, [program.arrive == program.leave])
        except ValueError:
            continue
        so_far[x], to_go[x] = program.legs.value[: k + 1].sum(), program.legs.value[k + 1 :].sum()
    return so_far, to_go


class _Program:
    """The SOCP of a route's legs, without the rows that tie arrival and departure together."""

    def __init__(self, graph, route, start, end):
        K, nodes = len(route), [graph.s, *route, graph.s_prime]
        self.arrive, self.leave, self.legs = cp.Variable(K), cp.Variable(K), cp.Variable(K + 1)
        tail, head = cp.hstack([0.0, self.leave]), cp.hstack([self.arrive, graph.horizon])
        v, origin = graph.v[nodes], graph.p_lo[nodes] - graph.t_lo[nodes, None] * graph.v[nodes]
        apart = [
            origin[1:, x] - origin[:-1, x] + cp.multiply(v[1:, x], head) - cp.multiply(v[:-1, x], tail) for x in (0, 1)
        ]
        self.rows = [cp.SOC(self.legs, cp.vstack(apart)), self.legs <= graph.max_speed * (head - tail)]
        self.rows += [row for time in (self.arrive, self.leave) for row in (start <= time, time <= end)]

    def minimise(self, extra, rows):
        """Return the least total length plus `extra`; ValueError if nothing is feasible."""
        problem = cp.Problem(cp.Minimize(cp.sum(self.legs) + extra), [*self.rows, *rows])
        problem.solve(solver=cp.CLARABEL)
        if problem.status not in (cp.OPTIMAL, cp.OPTIMAL_INACCURATE):
            raise ValueError(f"route: no times can be flown, Clarabel says {problem.status}")
        return float(problem.value)
