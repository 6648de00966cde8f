"""Pieces of segments, and an affine minorant of the flying distance between any two of them.

A piece is a part [a, b] of a segment. On a pair of pieces (q, r) the distance d(t_q, t_r) = ||p_r(t_r) - p_q(t_q)|| is
jointly convex, so its tangent plane at the two middles lies below it everywhere; the error is of second order in the
lengths of the pieces. All bounds of the exact solver are built from these planes, so they hold for every real tour.
"""

import math
from typing import NamedTuple

import numpy as np
from numba import njit

from ..motion import TIME_SLACK, earliest_meeting


class Pieces(NamedTuple):
    """Q pieces ordered by segment, then time, and their legs.

    segment, target: (Q,) node of the graph and target; a, b: (Q,) start and end in s; p, v: (Q, 2) position at a,
    velocity. legs: (Q, Q, 3) for each pair (q, r) the minorant's value at (a_q, a_r), its slope in t_q and its slope
    in t_r; the value is infinite where no agent can fly from q to r in time.
    first, last: (Q, 2) the same for the legs from and to the depot: value at a, slope.
    ready: (Q,) earliest time at which an agent from the depot can be at q, infinite if never.
    depot: (2,); speed: v_max; horizon: T.
    """

    segment: np.ndarray
    target: np.ndarray
    a: np.ndarray
    b: np.ndarray
    p: np.ndarray
    v: np.ndarray
    legs: np.ndarray
    first: np.ndarray
    last: np.ndarray
    ready: np.ndarray
    depot: np.ndarray
    speed: float
    horizon: float


def make_pieces(graph, segment, a, b, targets):
    """Return the Pieces with the given segments (Q,), starts and ends (Q,) in s; targets: those served, numbered
    from 0 in this order in the pieces."""
    v = np.ascontiguousarray(graph.v[segment])
    p = graph.p_lo[segment] + (a - graph.t_lo[segment])[:, None] * v
    number = np.full(graph.n_targets, -1)
    number[list(targets)] = np.arange(len(targets))
    target = number[graph.tau[segment]]
    depot = graph.p_lo[graph.s].copy()
    legs = _legs(target, a, b, p, v, graph.max_speed)
    first, last, ready = _depot_legs(a, b, p, v, depot, graph.max_speed, graph.horizon)
    return Pieces(segment, target, a, b, p, v, legs, first, last, ready, depot, graph.max_speed, graph.horizon)


def even_cuts(graph, segments, width):
    """Return (segment, a, b), each (Q,): the segments cut into equal pieces of at most `width` seconds."""
    rows = []
    for i in segments:
        count = max(1, math.ceil((graph.t_hi[i] - graph.t_lo[i]) / width - 1e-9))
        points = np.linspace(graph.t_lo[i], graph.t_hi[i], count + 1)
        rows += [(i, start, end) for start, end in zip(points[:-1], points[1:])]
    segment, a, b = zip(*rows)
    return np.array(segment), np.array(a), np.array(b)


@njit(cache=True)
def _tangent(dx, dy, vqx, vqy, vrx, vry):
    """Return the distance |d| and its slopes in the time at the tail and at the head."""
    d = math.hypot(dx, dy)
    if d == 0.0:
        return 0.0, 0.0, 0.0
    return d, -(dx * vqx + dy * vqy) / d, (dx * vrx + dy * vry) / d


@njit(cache=True)
def _legs(target, a, b, p, v, speed):
    legs = np.full((len(a), len(a), 3), np.inf)
    for q in range(len(a)):
        for r in range(len(a)):
            if target[q] == target[r]:
                continue
            meeting = earliest_meeting(
                p[q, 0], p[q, 1], a[q], p[r, 0], p[r, 1], a[r], v[r, 0], v[r, 1], a[r], b[r], speed
            )
            if meeting == np.inf:
                continue
            hq, hr = 0.5 * (b[q] - a[q]), 0.5 * (b[r] - a[r])
            dx = p[r, 0] + hr * v[r, 0] - p[q, 0] - hq * v[q, 0]
            dy = p[r, 1] + hr * v[r, 1] - p[q, 1] - hq * v[q, 1]
            d, in_q, in_r = _tangent(dx, dy, v[q, 0], v[q, 1], v[r, 0], v[r, 1])
            legs[q, r, 0] = d - in_q * hq - in_r * hr
            legs[q, r, 1] = in_q
            legs[q, r, 2] = in_r
    return legs


@njit(cache=True)
def _depot_legs(a, b, p, v, depot, speed, horizon):
    Q = len(a)
    first, last, ready = np.full((Q, 2), np.inf), np.full((Q, 2), np.inf), np.full(Q, np.inf)
    for q in range(Q):
        half = 0.5 * (b[q] - a[q])
        d, _, slope = _tangent(
            p[q, 0] + half * v[q, 0] - depot[0], p[q, 1] + half * v[q, 1] - depot[1], 0.0, 0.0, v[q, 0], v[q, 1]
        )
        ready[q] = earliest_meeting(
            depot[0], depot[1], 0.0, p[q, 0], p[q, 1], a[q], v[q, 0], v[q, 1], a[q], b[q], speed
        )
        if ready[q] < np.inf:
            first[q] = d - slope * half, slope
        home = a[q] + math.hypot(p[q, 0] - depot[0], p[q, 1] - depot[1]) / speed
        if home <= horizon + TIME_SLACK * (1.0 + horizon):
            last[q] = d - slope * half, slope
    return first, last, ready
