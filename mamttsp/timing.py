"""The best times for a given order of segments: a small SOCP, and earliest and latest times in closed form."""

import functools
import math

import numpy as np
from scipy import sparse

from .conic_solver import claims_optimal, dual_point, minimise
from .motion import earliest_meeting
from .tours import Tour, Visit


def earliest_times(graph, route):
    """Return the earliest visit times (len(route),) of the segments in order, or None if they cannot be flown in time.

    route: nodes of V_seg in the order of their visits. Flying at v_max is best for time: movers are slower than agents.
    """
    times = np.empty(len(route))
    if not len(route):
        return times
    s, s_prime = _ends(graph, route)
    t, p = 0.0, graph.p_lo[s]
    for k, i in enumerate(route):
        times[k] = t = _meeting(graph, p, t, i)
        if math.isinf(t):
            return None
        p = graph.position(i, t)
    return None if math.isinf(_meeting(graph, p, t, s_prime)) else times


def _ends(graph, route):
    """Return the depot s and the end s' of the layer in which the route is."""
    layer = graph.layer[route[0]]
    return graph.starts[layer], graph.ends[layer]


def _meeting(graph, p, t, i):
    q, v, v_max = graph.p_lo[i], graph.v[i], graph.speeds[graph.layer[i]]
    return earliest_meeting(p[0], p[1], t, q[0], q[1], graph.t_lo[i], v[0], v[1], graph.t_lo[i], graph.t_hi[i], v_max)


def best_times(graph, route):
    """Return (length, times): the shortest tour through the segments of `route` in order, None if none is in time.

    times: (len(route),) visit times in s. The times come from an SOCP (Clarabel) and are then nudged forward onto
    times that can be flown exactly, so `length` is the length of a real tour, within about 1e-8 of the optimum.
    """
    found = bounded_times(graph, route)
    return None if found is None else found[:2]


def bounded_times(graph, route):
    """Return (length, times, bound): as `best_times`, with the SOCP's dual bound on every tour of this order.

    The bound holds whatever the accuracy of Clarabel's answer.
    """
    earliest = earliest_times(graph, route)
    if earliest is None:
        return None
    solved, bound = _solve_times(graph, route)
    candidates = [earliest] if solved is None else [earliest, _flyable_times(graph, route, solved)]
    length, times = min(
        ((float(leg_lengths(graph, route, times).sum()), times) for times in candidates), key=lambda found: found[0]
    )
    return length, times, min(bound, length)


def best_tours(graph, routes):
    """Return (length, tours) for a set of routes, each with its best times; None if one of them cannot be flown."""
    total, tours = 0.0, []
    for route in routes:
        found = best_times(graph, route)
        if found is None:
            return None
        total += found[0]
        tours.append(to_tour(graph, route, found[1]))
    return total, tours


def to_tour(graph, route, times):
    """Return the Tour through the segments of `route` at the given times, back at the depot as soon as can be."""
    visits = tuple(
        Visit(int(graph.tau[i]), float(t), tuple(map(float, graph.position(i, t)))) for i, t in zip(route, times)
    )
    if not visits:
        return Tour((), 0.0)
    home = _meeting(graph, visits[-1].position, visits[-1].time, _ends(graph, route)[1])
    agent = int(graph.types[graph.layer[route[0]]]) if graph.numbered else None
    return Tour(visits, float(min(home, graph.horizon)), agent)


def leg_lengths(graph, route, times):
    """Return (len(route) + 1,) the lengths of a tour's legs, through the segments at the given times."""
    s, s_prime = _ends(graph, route)
    stops = np.vstack([graph.p_lo[s], *(graph.position(i, t) for i, t in zip(route, times)), graph.p_lo[s_prime]])
    return np.linalg.norm(np.diff(stops, axis=0), axis=1)


def _flyable_times(graph, route, times):
    """Pull each time forward to where all later visits can still be made, push it to where the agent can be by then."""
    flown = np.empty(len(route))
    t, p = 0.0, graph.p_lo[_ends(graph, route)[0]]
    for k, (i, latest) in enumerate(zip(route, _latest_times(graph, route))):
        soonest = _meeting(graph, p, t, i)
        wish = min(max(times[k], graph.t_lo[i]), latest)
        flown[k] = t = graph.t_hi[i] if math.isinf(soonest) else max(wish, soonest)
        p = graph.position(i, t)
    return flown


def _latest_times(graph, route):
    """Return (len(route),) the latest times of the visits that leave time for all later ones, home by the horizon.

    Seen backwards in time these are earliest meetings, with motions reversed.
    """
    latest = np.empty(len(route))
    t, p, v_max = graph.horizon, graph.p_lo[_ends(graph, route)[1]], graph.speeds[graph.layer[route[0]]]
    for k, i in reversed(list(enumerate(route))):
        q, v, start, end = graph.p_hi[i], -graph.v[i], -graph.t_hi[i], -graph.t_lo[i]
        back = earliest_meeting(p[0], p[1], -t, q[0], q[1], start, v[0], v[1], start, end, v_max)
        latest[k] = t = max(-back, graph.t_lo[i])
        p = graph.position(i, t)
    return latest


def _solve_times(graph, route):
    """Return (times, bound): the optimal visit times of a fixed order, None if Clarabel does not answer, and the
    dual bound."""
    cost, A, b, size, (least, most) = _program(graph, route)
    answer = minimise(cost, A, b, *size)
    z = dual_point(answer, *size)
    residual = cost + A.T @ z
    bound = float(-b @ z + np.minimum(residual * least, residual * most).sum()) * _unit(graph)
    return np.array(answer.x[: len(route)]) * graph.horizon if claims_optimal(answer) else None, bound


def _unit(graph):
    """The length that is 1 in the program, near all others."""
    return graph.size or 1.0


def _program(graph, route):
    """Return (cost, A, b, size, bounds) of the SOCP of a fixed order: min cost x, b - A x in `size` cones, see
    `conic_solver.minimise`; bounds: the least and the most that x can be.

    x: times t_1..t_K and leg lengths l_0..l_K, in the units T and R of the instance so that the data are near one.
    Rows: windows; l_k <= v_max * (t_k+1 - t_k); ||p_k+1(t_k+1) - p_k(t_k)|| <= l_k as second-order cones.
    """
    K, R, T = len(route), _unit(graph), graph.horizon
    s, s_prime = _ends(graph, route)
    nodes = [s, *route, s_prime]
    speed, v = graph.speeds[graph.layer[s]] * T / R, graph.v[route] * T / R
    offset = np.diff(graph.p_lo[nodes] - graph.t_lo[nodes, None] * graph.v[nodes], axis=0) / R
    opens, closes = graph.t_lo[route] / T, graph.t_hi[route] / T
    ones, none = np.ones(K + 1), np.zeros(K + 1)
    by_speed, by_v = np.repeat([-1.0, 1.0, -speed, speed], K), np.c_[-v[:, 0], v[:, 0], -v[:, 1], v[:, 1]].ravel("F")
    row, column_ends, order = _pattern(K)
    values = np.concatenate([by_speed, ones, -ones, by_v])[order]
    A = sparse.csc_matrix((values, row, column_ends), shape=(6 * K + 4, 2 * K + 1))
    b = np.r_[-opens, closes, none[1:], speed, np.c_[none, offset].ravel()]  # t_0 = 0, the last arrival up to T
    bounds = np.r_[opens, none], np.r_[closes, min(speed, 1.0) * ones]  # no leg is longer than R
    return np.r_[none[1:], ones], A, b, (0, 3 * K + 1), bounds


@functools.cache
def _pattern(K):
    """Return (row of each entry, ends of the columns, order): where A of a program of K visits has entries, column by
    column, and the order that sorts its values so."""
    k, leg = np.arange(K), np.arange(K + 1)
    into, out, cone = leg[:-1], leg[1:], 3 * K + 1 + 3 * leg  # the legs into and out of each visit; heads of the cones
    entries = [(k, k), (K + k, k), (2 * K + into, k), (2 * K + out, k), (2 * K + leg, K + leg), (cone, K + leg)]
    entries += [(cone[legs] + 1 + axis, k) for axis in (0, 1) for legs in (into, out)]
    row, column = (np.concatenate(part) for part in zip(*entries))
    order = np.lexsort((row, column))
    ends = np.searchsorted(column[order], np.arange(2 * K + 2))
    return row[order].astype(np.int32), ends.astype(np.int32), order
