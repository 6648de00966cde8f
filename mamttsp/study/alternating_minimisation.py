"""A local method for the nonconvex program, to compare with a global one: times and flow improved in turn."""

import itertools

import numpy as np
from scipy.optimize import LinearConstraint, milp

from ..timing import best_times, earliest_times

#: relative slack within which a hop counts as in time; improvements below it end the method
_SLACK = 1e-9


def alternate(graph, route):
    """Return [(length, route), ...]: what a single agent's route becomes, step by step, until neither half helps.

    route: segments in order that can be flown in time. With the flow fixed, the products (16) are linear and the best
    times come from a cone program; with the times fixed they are linear again, and the best flow comes from a linear
    one with whole numbers. Segments that are not visited keep the middle of their interval.
    """
    t = (graph.t_lo + graph.t_hi) / 2.0
    t[graph.s_prime] = graph.horizon
    steps = []
    while route is not None:
        length, times = best_times(graph, list(route))
        if steps and length > steps[-1][0] * (1.0 - _SLACK):
            return steps
        steps.append((length, tuple(route)))
        t[list(route)] = times
        route = best_route(graph, t)
    return steps


def best_route(graph, t):
    """Return the shortest route of one agent that meets segments at their times t (|V|,) only; None if none is."""
    i, j = graph.edges.T
    p = graph.p_lo + (t - graph.t_lo)[:, None] * graph.v
    p[graph.s_prime] = p[graph.s]
    d = np.linalg.norm(p[j] - p[i], axis=1)
    in_time = d <= graph.max_speed * (t[j] - t[i]) + _SLACK * graph.size
    V_seg = np.array(graph.V_seg)[:, None]
    entered = np.array([graph.tau[j] == u for u in range(graph.n_targets)], dtype=float)  # (4)
    balance = (j == V_seg).astype(float) - (i == V_seg)  # (5)
    leaving = (i == graph.s).astype(float)  # (2)
    rows = [LinearConstraint(leaving, 0, 1), LinearConstraint(entered, 1, 1), LinearConstraint(balance, 0, 0)]
    found = milp(d, integrality=np.ones(len(d)), bounds=(0, in_time.astype(float)), constraints=rows)
    if found.x is None:
        return None
    after = {int(i[e]): int(j[e]) for e in np.flatnonzero(found.x > 0.5)}
    route = [after[graph.s]]
    while after[route[-1]] != graph.s_prime:
        route.append(after[route[-1]])
    return route


def flyable_routes(graph):
    """Return all routes of a single agent through every target that can be flown in time; for a few targets only."""
    orders = itertools.permutations(range(graph.n_targets))
    routes = (route for order in orders for route in itertools.product(*(graph.C(u).tolist() for u in order)))
    return [route for route in routes if earliest_times(graph, route) is not None]
