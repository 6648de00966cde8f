"""Labels: elementary partial routes on pieces, extended forward, with exact earliest times.

A label is a set of visited targets, a last piece, an affine minorant (left, right) of the reduced cost of being there
at each time, and the exact earliest time at which its sequence of pieces can be there; so every complete label is a
flyable tour. A label is dropped if no completion keeps it within the limit, or if another one with the same set and
last piece is nowhere worse (dominance on bounds: the least bound of all complete labels stays a bound on every route).
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled
from ..motion import earliest_meeting
from .completions import completed, promising, shifts
from .legs import after_leg, least, share_before
from .ngroutes import penalty
from .sets import add, has, same, to_words

_EPS = 1e-12
_FIRST_SIZE = 1 << 12
#: extensions between two looks at the clock, some tenths of a second
_AT_ONCE = 500_000


class Labels(NamedTuple):
    """The X labels of one number of visits.

    visited: (X, W) set of targets; odd: (X,) the subset-row cuts of whose rows it serves an odd number; load: (X,)
    their demand; piece: (X,) last piece; left, right: (X,) reduced cost at its ends; early: (X,) earliest time there in
    s; parent: (X,) label of one visit less, -1 for none.
    """

    visited: np.ndarray
    odd: np.ndarray
    load: np.ndarray
    piece: np.ndarray
    left: np.ndarray
    right: np.ndarray
    early: np.ndarray
    parent: np.ndarray


@compiled
def _empty(size, W):
    return Labels(
        np.zeros((size, W), np.uint64), np.empty(size, np.uint64), np.empty(size), np.empty(size, np.int32),
        np.empty(size), np.empty(size), np.empty(size), np.empty(size, np.int32),
    )  # fmt: skip


@compiled
def _grown(labels):
    """Return the Labels with room for as many again."""
    size, W = labels.visited.shape
    more = _empty(2 * size, W)
    for x in range(size):
        for z in range(W):
            more.visited[x, z] = labels.visited[x, z]
        more.odd[x], more.load[x], more.piece[x] = labels.odd[x], labels.load[x], labels.piece[x]
        more.left[x], more.right[x], more.early[x] = labels.left[x], labels.right[x], labels.early[x]
        more.parent[x] = labels.parent[x]
    return more


def first_labels(evaluations, limit):
    """Return the Labels of one visit, straight from the depot: pieces where a route of a solution of value at most
    `limit` may begin. Their reduced costs are at the prices of the first of the evaluations."""
    pieces, prices = evaluations[0].pieces, evaluations[0].prices
    piece = np.flatnonzero(np.all([e.cost <= e.slack(limit)[pieces.layer] for e in evaluations], axis=0))
    u, layer, parent = pieces.target[piece], pieces.layer[piece], np.full(len(piece), -1, np.int32)
    visited = to_words(u[:, None] == np.arange(len(prices.pi)))
    left, right = (pieces.first[piece] - prices.pi[u][:, None]).T.copy()
    return Labels(
        visited, prices.inside[u], pieces.demand[layer, u], piece.astype(np.int32), left, right, pieces.ready[piece],
        parent,
    )  # fmt: skip


class _Grown(NamedTuple):
    """Labels of one visit more so far: the first `count` of `new`, the dominated among them; following: (X,) the next
    label of a chain; heir: (X,) what dominates each of them, or -1; head: (power of 2,) the first of each chain; links:
    the first `linked` are in use."""

    new: Labels
    count: int
    following: np.ndarray
    heir: np.ndarray
    head: np.ndarray
    links: np.ndarray
    linked: int


@compiled
def _none_grown(W):
    return _Grown(
        _empty(np.int64(_FIRST_SIZE), W), np.int64(0), np.empty(_FIRST_SIZE, np.int32),
        np.full(_FIRST_SIZE, -1, np.int32), np.full(4 * _FIRST_SIZE, -1, np.int32),
        np.empty((_FIRST_SIZE, 2), np.int32), np.int64(0),
    )  # fmt: skip


def extend(old, pieces, arcs, completions, most, out):
    """Extend every label of one number of visits along every arc, and drop what is dominated.

    Returns (labels, links, complete): those of one visit more; links: (Y, 2) pairs (old label, new label) of all
    extensions within the limit, the dominated ones linked to what dominates them; complete is False if more than `most`
    labels were needed, or out() told in the middle that time is up, and the labels are then of no use.
    """
    order = np.lexsort((old.left + old.right, *old.visited.T))
    due = np.cumsum(np.diff(arcs.start)[old.piece[order]]) // _AT_ONCE
    grown, complete = _none_grown(old.visited.shape[1]), True
    for part in np.split(order, np.flatnonzero(np.diff(due)) + 1):
        grown, complete = _extend(old, part, pieces, arcs, completions, most, grown)
        if not complete or out():
            return grown.new, grown.links, False
    new, count, _, heir, _, links, linked = grown
    links = links[:linked]
    keep = np.flatnonzero(heir[:count] < 0)
    _hand_on(links, heir, count)
    return Labels(*(part[keep] for part in new)), links, True


@compiled
def _hand_on(links, heir, count):
    """Let links to each of `count` labels lead to what dominates it in the end, and count only those that stay."""
    place, stay = np.empty(count, np.int32), 0
    for y in range(count):
        if heir[y] < 0:
            place[y] = stay
            stay += 1
    for y in range(count - 1, -1, -1):  # heirs come later
        if heir[y] >= 0:
            place[y] = place[heir[y]]
    for k in range(len(links)):
        links[k, 1] = place[links[k, 1]]


@compiled
def _extend(old, order, pieces, arcs, completions, most, grown):
    """Return (_Grown, complete): `grown`, with what comes of the old labels in `order`, which are some of them.

    One set after the other they lead to sets that were touched last, and the cheapest first to labels that dominate the
    others.

    All in one function, with arrays unpacked first: numba counts references at each call and attribute otherwise.
    """
    W = old.visited.shape[1]
    new, count, following, heir, head, links, linked = grown
    a, b, p, v, target, demand = pieces.a, pieces.b, pieces.p, pieces.v, pieces.target, pieces.demand
    start, heads, leg = arcs.start, arcs.head, arcs.leg
    pi, limit, inside, sigma, best, span, value, memory, parity, load = completions
    fresh, shift, turn = np.zeros((1, W), np.uint64), np.zeros(len(pi)), np.arange(len(pi))
    for x in order:
        q = old.piece[x]
        layer = pieces.layer[q]
        speed, room = pieces.speed[layer], pieces.room[layer] - old.load[x]
        a_q, width_q = a[q], b[q] - a[q]
        since = max(0.0, old.early[x] - a_q)
        px, py = p[q, 0] + since * v[q, 0], p[q, 1] + since * v[q, 1]
        if len(pi) > 1:
            shifts(old.visited, x, pi, shift)
        for arc in range(start[q], start[q + 1]):
            r = heads[arc]
            w = target[r]
            if has(old.visited, x, w) or demand[layer, w] > room:
                continue
            width = b[r] - a[r]
            hits = old.odd[x] & inside[w]
            pay = penalty(hits, sigma) - pi[0, w] if hits else -pi[0, w]
            left, right = after_leg(
                leg[arc, 0], leg[arc, 1], leg[arc, 2], old.left[x], old.right[x], width_q, width, a[r] - a_q, speed,
                since, 0.0,
            )  # fmt: skip
            # Most end here, before any root is taken.
            if not promising(left + pay, right + pay, r, layer, w, shift, turn, pi, limit, best):
                continue
            early = earliest_meeting(px, py, a_q + since, p[r, 0], p[r, 1], a[r], v[r, 0], v[r, 1], a[r], b[r], speed)
            if early == np.inf:
                continue
            share = share_before(early, a[r], width)
            left, right = after_leg(
                leg[arc, 0], leg[arc, 1], leg[arc, 2], old.left[x], old.right[x], width_q, width, a[r] - a_q, speed,
                since, share,
            )  # fmt: skip
            left += pay
            right += pay
            for z in range(W):
                fresh[0, z] = old.visited[x, z]
            add(fresh, 0, w)
            odd = old.odd[x] ^ inside[w]
            fits = completed(
                fresh, odd, room - demand[layer, w], left, right, share, r, layer, w, shift, turn, pi, limit, sigma,
                span, value, memory, parity, load,
            )  # fmt: skip
            if not fits:
                continue
            if linked == len(links):
                links = np.concatenate((links, np.empty_like(links)))
            links[linked, 0] = x
            slot = _slot_of(fresh, np.int64(0), r, len(head))
            better = _dominate(
                new, head[slot], following, heir, count, fresh, r, left, right, early, share, a[r], width
            )
            if better >= 0:
                links[linked, 1] = better
                linked += 1
                continue
            links[linked, 1] = count
            linked += 1
            if count >= most:
                return _Grown(new, count, following, heir, head, links, linked), False
            if count == len(new.left):
                new = _grown(new)
                following = np.concatenate((following, np.empty_like(following)))
                heir = np.concatenate((heir, np.full(len(heir), -1, np.int32)))
                head = _rehash(new, count, 4 * len(new.left), following)
                slot = _slot_of(fresh, np.int64(0), r, len(head))
            for z in range(W):
                new.visited[count, z] = fresh[0, z]
            new.odd[count], new.load[count], new.piece[count] = odd, old.load[x] + demand[layer, w], r
            new.left[count], new.right[count] = left, right
            new.early[count], new.parent[count] = early, x
            following[count] = head[slot]
            head[slot] = count
            count += 1
    return _Grown(new, count, following, heir, head, links, linked), True


@compiled
def _slot_of(visited, x, piece, size):
    """Return where in a table of `size`, a power of 2, the labels of a set and piece are chained."""
    key = np.uint64(piece) * np.uint64(0xC2B2AE3D27D4EB4F)
    for w in range(visited.shape[1]):
        key = (key ^ visited[x, w]) * np.uint64(0x9E3779B97F4A7C15)
        key ^= key >> np.uint64(29)
    return np.int64(key & np.uint64(size - 1))


@compiled
def _rehash(labels, count, size, following):
    """Return a table of `size` with the chains of the first `count` labels, linked by `following`."""
    head = np.full(size, -1, np.int32)
    for y in range(count):
        slot = _slot_of(labels.visited, y, labels.piece[y], size)
        following[y] = head[slot]
        head[slot] = y
    return head


@compiled
def _dominate(new, y, following, heir, count, visited, r, left, right, early, share, start, width):
    """Return a label of the chain from y that dominates the candidate, or -1; what the candidate dominates gets it
    as heir."""
    value = left + (right - left) * share
    x = y
    while x >= 0:
        if heir[x] < 0 and new.piece[x] == r and same(new.visited, x, visited, 0):
            there = new.left[x] + (new.right[x] - new.left[x]) * share
            if new.early[x] <= early + _EPS and there <= value + _EPS and new.right[x] <= right + _EPS:
                return x
        x = following[x]
    while y >= 0:
        if heir[y] < 0 and new.piece[y] == r and same(new.visited, y, visited, 0) and early <= new.early[y]:
            later = share_before(new.early[y], start, width)
            there = new.left[y] + (new.right[y] - new.left[y]) * later
            if left + (right - left) * later <= there and right <= new.right[y]:
                heir[y] = count
        y = following[y]
    return -1


@compiled
def closings(labels, pieces):
    """Return (X,) the reduced cost of each label's route with its flight home, infinite if it would come too late."""
    cost = np.full(len(labels.left), np.inf)
    for x in range(len(labels.left)):
        q = labels.piece[x]
        if pieces.last[q, 0] == np.inf:
            continue
        layer, start = pieces.layer[q], max(0.0, labels.early[x] - pieces.a[q])
        home = earliest_meeting(
            pieces.p[q, 0] + start * pieces.v[q, 0], pieces.p[q, 1] + start * pieces.v[q, 1], pieces.a[q] + start,
            pieces.end[layer, 0], pieces.end[layer, 1], 0.0, 0.0, 0.0, 0.0, pieces.horizon, pieces.speed[layer],
        )  # fmt: skip
        if home < np.inf:
            share = share_before(labels.early[x], pieces.a[q], pieces.b[q] - pieces.a[q])
            cost[x] = least(labels.left[x] + pieces.last[q, 0], labels.right[x] + pieces.last[q, 1], share)
    return cost
