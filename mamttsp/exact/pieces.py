"""Pieces of segments, and the arcs between them: the time-expanded graph on which the exact solver's bounds live."""

import math
from typing import NamedTuple

import numpy as np

from ..compiled import compiled
from ..motion import TIME_SLACK, earliest_meeting
from .legs import tangent


class Pieces(NamedTuple):
    """Q pieces, ordered by segment, then time.

    segment, target, layer: (Q,) node of the graph, target, and layer of the graph (type of agents); a, b: (Q,) start
    and end in s; p, v: (Q, 2) position at a, velocity. first, last: (Q, 2) minorants of the legs from the depot and to
    the end: value at a, at b; infinite where they cannot be flown. ready: (Q,) earliest time at which an agent from the
    depot can be at q, infinite if never.

    Of K layers: end: (K, 2); speed: (K,) v_max; demand: (K, n) what serving each target takes, 0 where all fits; room:
    (K,) what an agent can carry. horizon: T.
    """

    segment: np.ndarray
    target: np.ndarray
    layer: np.ndarray
    a: np.ndarray
    b: np.ndarray
    p: np.ndarray
    v: np.ndarray
    first: np.ndarray
    last: np.ndarray
    ready: np.ndarray
    end: np.ndarray
    speed: np.ndarray
    demand: np.ndarray
    room: np.ndarray
    horizon: float

    def only(self, which):
        """Return the pieces marked in which (Q,)."""
        return Pieces(*(part[which] for part in self[:10]), *self[10:])


class Arcs(NamedTuple):
    """The pairs of pieces that an agent can fly, by tail: those from q are start[q]:start[q + 1].

    start: (Q + 1,); tail, head: (A,); leg: (A, 3) of each the minorant's value at (a_q, a_r), and its slopes in t_q and
    in t_r.
    """

    start: np.ndarray
    tail: np.ndarray
    head: np.ndarray
    leg: np.ndarray


def make_pieces(graph, segment, a, b, targets):
    """Return the Pieces with the given segments (Q,), starts and ends (Q,) in s; targets: those served, numbered
    from 0 in this order in the pieces."""
    v = np.ascontiguousarray(graph.v[segment])
    p = graph.p_lo[segment] + (a - graph.t_lo[segment])[:, None] * v
    number = np.full(graph.n_targets, -1)
    number[list(targets)] = np.arange(len(targets))
    target, layer = number[graph.tau[segment]], graph.layer[segment]
    everything = graph.demands.sum()
    demand = np.where(graph.room[:, None] < everything, graph.demands[list(targets)], 0.0)
    depot, end, speed, room = graph.p_lo[graph.starts], graph.p_lo[graph.ends], graph.speeds, graph.room
    first, last, ready = _end_legs(a, b, p, v, layer, depot, end, speed, graph.horizon)
    heavy = demand[layer, target] > room[layer]
    first[heavy], last[heavy], ready[heavy] = np.inf, np.inf, np.inf
    return Pieces(segment, target, layer, a, b, p, v, first, last, ready, end, speed, demand, room, graph.horizon)


def even_cuts(graph, segments, width):
    """Return (segment, a, b), each (Q,): the segments cut into equal pieces of at most `width` seconds."""
    rows = []
    for i in segments:
        count = max(1, math.ceil((graph.t_hi[i] - graph.t_lo[i]) / width - 1e-9))
        points = np.linspace(graph.t_lo[i], graph.t_hi[i], count + 1)
        rows += [(i, start, end) for start, end in zip(points[:-1], points[1:])]
    segment, a, b = zip(*rows)
    return np.array(segment), np.array(a), np.array(b)


def finer(pieces, width, centre):
    """Return (segment, a, b, origin): the pieces cut into parts of about `width` s, and which piece each is of, in
    order. centre: {segment: visit time in s}, to lie in the middle of a part."""
    rows = []
    for q in range(len(pieces.a)):
        for start, end in _split(pieces.a[q], pieces.b[q], width, centre.get(int(pieces.segment[q]))):
            rows.append((pieces.segment[q], start, end, q))
    return tuple(np.array(part) for part in zip(*rows))


def _split(a, b, width, centre=None):
    """Return (start, end) pairs that cut [a, b] into parts of about `width`, one of them around `centre` if that is
    inside."""
    if centre is None or not a < centre < b:
        points = np.linspace(a, b, max(1, math.ceil((b - a) / width - 1e-9)) + 1)
    else:
        steps = np.arange(math.floor((a - centre) / width), math.ceil((b - centre) / width) + 1) - 0.5
        inner = centre + steps * width
        points = np.r_[a, inner[(inner > a + 0.1 * width) & (inner < b - 0.1 * width)], b]
    return zip(points[:-1], points[1:])


@compiled
def _end_legs(a, b, p, v, layer, depots, ends, speeds, horizon):
    Q = len(a)
    first, last, ready = np.full((Q, 2), np.inf), np.full((Q, 2), np.inf), np.full(Q, np.inf)
    for q in range(Q):
        half, k = 0.5 * (b[q] - a[q]), layer[q]
        x, y = p[q, 0] + half * v[q, 0], p[q, 1] + half * v[q, 1]
        ready[q] = earliest_meeting(
            depots[k, 0], depots[k, 1], 0.0, p[q, 0], p[q, 1], a[q], v[q, 0], v[q, 1], a[q], b[q], speeds[k]
        )
        if ready[q] < np.inf:
            d, _, slope = tangent(x - depots[k, 0], y - depots[k, 1], 0.0, 0.0, v[q, 0], v[q, 1])
            first[q, 0], first[q, 1] = d - slope * half, d + slope * half
        home = a[q] + math.hypot(p[q, 0] - ends[k, 0], p[q, 1] - ends[k, 1]) / speeds[k]
        if home <= horizon + TIME_SLACK * (1.0 + horizon):
            d, _, slope = tangent(x - ends[k, 0], y - ends[k, 1], 0.0, 0.0, v[q, 0], v[q, 1])
            last[q, 0], last[q, 1] = d - slope * half, d + slope * half
    return first, last, ready


def all_arcs(pieces):
    """Return the Arcs between pieces of different targets in a layer that one agent can fly in time, and carry."""
    everything = np.zeros(1, np.int32)  # one parent, with an arc to itself
    loop = Arcs(np.array([0, 1]), everything, everything, np.zeros((1, 3)))
    return finer_arcs(pieces, np.zeros(len(pieces.a), np.int64), loop)


def finer_arcs(pieces, origin, parents):
    """Return the Arcs between `pieces`, parts of the pieces `origin` (Q,), in order, of another set, along that set's
    Arcs."""
    first = np.searchsorted(origin, np.arange(len(parents.start)))
    start, head, leg = _make_arcs(pieces, origin, first, parents.start, parents.head)
    tail = np.repeat(np.arange(len(origin), dtype=np.int32), np.diff(start))
    return Arcs(start, tail, head, leg)


@compiled
def _make_arcs(pieces, origin, first, parent_start, parent_head):
    """Return (start, head, leg) as in Arcs; the parts of parent r are first[r]:first[r + 1]."""
    Q = len(pieces.a)
    start = np.zeros(Q + 1, np.int64)
    for q in range(Q):
        start[q + 1] = start[q]
        for x in range(parent_start[origin[q]], parent_start[origin[q] + 1]):
            for r in range(first[parent_head[x]], first[parent_head[x] + 1]):
                start[q + 1] += _flyable(pieces, q, r)
    head, leg, k = np.empty(start[Q], np.int32), np.empty((start[Q], 3)), 0
    for q in range(Q):
        for x in range(parent_start[origin[q]], parent_start[origin[q] + 1]):
            for r in range(first[parent_head[x]], first[parent_head[x] + 1]):
                if _flyable(pieces, q, r):
                    head[k] = r
                    _set_leg(pieces, q, r, leg[k])
                    k += 1
    return start, head, leg


@compiled
def _flyable(pieces, q, r):
    k, u, w = pieces.layer[q], pieces.target[q], pieces.target[r]
    if u == w or k != pieces.layer[r] or pieces.ready[q] == np.inf or pieces.last[r, 0] == np.inf:
        return False
    if pieces.demand[k, u] + pieces.demand[k, w] > pieces.room[k]:
        return False
    # Targets are slower than agents: who cannot be at the end of r from the start of q can never be at r.
    available = pieces.b[r] - pieces.a[q]
    if available < -TIME_SLACK * (1.0 + abs(pieces.b[r])):
        return False
    width = pieces.b[r] - pieces.a[r]
    d = math.hypot(
        pieces.p[r, 0] + width * pieces.v[r, 0] - pieces.p[q, 0],
        pieces.p[r, 1] + width * pieces.v[r, 1] - pieces.p[q, 1],
    )
    return d <= pieces.speed[k] * (available + TIME_SLACK * (1.0 + abs(pieces.b[r])))


@compiled
def _set_leg(pieces, q, r, leg):
    hq, hr = 0.5 * (pieces.b[q] - pieces.a[q]), 0.5 * (pieces.b[r] - pieces.a[r])
    d, in_q, in_r = tangent(
        pieces.p[r, 0] + hr * pieces.v[r, 0] - pieces.p[q, 0] - hq * pieces.v[q, 0],
        pieces.p[r, 1] + hr * pieces.v[r, 1] - pieces.p[q, 1] - hq * pieces.v[q, 1],
        pieces.v[q, 0], pieces.v[q, 1], pieces.v[r, 0], pieces.v[r, 1],
    )  # fmt: skip
    leg[0], leg[1], leg[2] = d - in_q * hq - in_r * hr, in_q, in_r


def select(arcs, alive):
    """Return the Arcs that are marked in alive (A,)."""
    ends = np.r_[0, np.cumsum(alive)]
    return Arcs(ends[arcs.start], arcs.tail[alive], arcs.head[alive], arcs.leg[alive])
