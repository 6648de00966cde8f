"""Labels: elementary partial routes on pieces, extended forward, with exact earliest times.

A label is a set of visited targets, a last piece, an affine minorant (left, right) of the reduced cost of being there
at each time, and the exact earliest time at which its sequence of pieces can be there; so every complete label is a
flyable tour. A label is dropped if its completion bound passes the limit, or if another one with the same set and last
piece is nowhere worse (dominance on bounds: the least bound of all complete labels stays a bound on every route).
"""

import numpy as np
from numba import njit

from ..motion import earliest_meeting
from .layer import empty, grown, put, rehash, select, slot_of
from .memory import local_memory
from .relaxed import after_leg

_EPS = 1e-12
_FIRST_SIZE = 1 << 14


@njit(cache=True)
def _share(time, start, width):
    """Return the part of a piece, from 0 to 1, that lies before `time`."""
    return max(0.0, time - start) / width if width > 0.0 else 0.0


@njit(cache=True)
def _least(left, right, share):
    """Return the least value of an affine function from `share` of its piece to the end."""
    return min(left + (right - left) * share, right)


@njit(cache=True)
def first_labels(pieces, pi, N, completion, alive, limit):
    """Return the Labels of one visit: straight from the depot."""
    labels = empty(len(pieces.a))
    x = 0
    for q in range(len(pieces.a)):
        if not alive[1, q] or pieces.ready[q] == np.inf:
            continue
        u = pieces.target[q]
        width = pieces.b[q] - pieces.a[q]
        left = pieces.first[q, 0] - pi[u]
        right = left + pieces.first[q, 1] * width
        visited = np.uint64(1) << np.uint64(u)
        rest = completion[1, q, local_memory(visited, N, u)]
        bound = _least(left + rest[0], right + rest[1], _share(pieces.ready[q], pieces.a[q], width))
        if bound <= limit:
            put(labels, x, visited, q, left, right, pieces.ready[q], -1, bound)
            x += 1
    return select(labels, np.arange(x))


@njit(cache=True)
def extend(old, s, pieces, pi, N, completion, alive, limit, most, budget):
    """Extend every label of a layer of s visits by every flyable piece, and drop what is dominated.

    Returns (labels, links, complete): the layer of s + 1 visits; links: (Y, 2) pairs (old label, new label) of all
    extensions within the limit, the dominated ones linked to what dominates them; complete is False if more than `most`
    labels or `budget` tried extensions were needed, and the labels are then of no use.

    All in one function: handing these arrays to another for every extension makes numba count references each time.
    """
    new, count = empty(_FIRST_SIZE), 0
    following = np.empty(_FIRST_SIZE, np.int32)
    heir = np.full(_FIRST_SIZE, -1, np.int32)  # the label that dominates a dropped one
    head = np.full(4 * _FIRST_SIZE, -1, np.int32)
    links, linked, tried = np.empty((_FIRST_SIZE, 2), np.int32), 0, 0
    for x in range(len(old.left)):
        q, visited = old.piece[x], old.visited[x]
        a_q, width_q = pieces.a[q], pieces.b[q] - pieces.a[q]
        start = max(0.0, old.early[x] - a_q)
        px, py = pieces.p[q, 0] + start * pieces.v[q, 0], pieces.p[q, 1] + start * pieces.v[q, 1]
        tried += len(pieces.a)
        if tried > budget:
            return new, links[:0], False
        for r in range(len(pieces.a)):
            if not alive[s + 1, r] or pieces.legs[q, r, 0] == np.inf:
                continue
            w = pieces.target[r]
            bit = np.uint64(1) << np.uint64(w)
            if visited & bit:
                continue
            rest = completion[s + 1, r, local_memory(visited | bit, N, w)]
            if rest[0] == np.inf:
                continue
            early = earliest_meeting(
                px, py, a_q + start, pieces.p[r, 0], pieces.p[r, 1], pieces.a[r], pieces.v[r, 0], pieces.v[r, 1],
                pieces.a[r], pieces.b[r], pieces.speed,
            )  # fmt: skip
            if early == np.inf:
                continue
            width = pieces.b[r] - pieces.a[r]
            share = _share(early, pieces.a[r], width)
            left, right = after_leg(
                pieces.legs[q, r, 0], pieces.legs[q, r, 1], pieces.legs[q, r, 2], old.left[x], old.right[x],
                width_q, width, pieces.a[r] - a_q, pieces.speed, start, share,
            )  # fmt: skip
            left -= pi[w]
            right -= pi[w]
            bound = _least(left + rest[0], right + rest[1], share)
            if bound > limit:
                continue
            if linked == len(links):
                links = np.concatenate((links, np.empty_like(links)))
            links[linked, 0] = x
            slot = slot_of(visited | bit, r, len(head))
            better = _dominate(
                new, head[slot], following, heir, count, visited | bit, r, left, right, early, share, pieces
            )
            if better >= 0:
                links[linked, 1] = better
                linked += 1
                continue
            links[linked, 1] = count
            linked += 1
            if count == len(new.left):
                if count >= most:
                    return new, links[:0], False
                new = grown(new)
                following = np.concatenate((following, np.empty_like(following)))
                heir = np.concatenate((heir, np.full(len(heir), -1, np.int32)))
                head = rehash(new, count, 4 * len(new.left), following)
                slot = slot_of(visited | bit, r, len(head))
            put(new, count, visited | bit, r, left, right, early, x, bound)
            following[count] = head[slot]
            head[slot] = count
            count += 1
    return _compact(new, count, heir, links[:linked])


@njit(cache=True)
def _dominate(new, y, following, heir, count, visited, r, left, right, early, share, pieces):
    """Return a label of the chain from y that dominates the candidate, or -1; what the candidate dominates gets it
    as heir."""
    start, width = pieces.a[r], pieces.b[r] - pieces.a[r]
    value = left + (right - left) * share
    x = y
    while x >= 0:
        if heir[x] < 0 and new.piece[x] == r and new.visited[x] == visited:
            there = new.left[x] + (new.right[x] - new.left[x]) * share
            if new.early[x] <= early + _EPS and there <= value + _EPS and new.right[x] <= right + _EPS:
                return x
        x = following[x]
    while y >= 0:
        if heir[y] < 0 and new.piece[y] == r and new.visited[y] == visited and early <= new.early[y]:
            later = _share(new.early[y], start, width)
            there = new.left[y] + (new.right[y] - new.left[y]) * later
            if left + (right - left) * later <= there and right <= new.right[y]:
                heir[y] = count
        y = following[y]
    return -1


@njit(cache=True)
def _compact(new, count, heir, links):
    """Take the dominated labels out, and let their links point to their heirs."""
    keep = np.flatnonzero(heir[:count] < 0)
    place = np.empty(count, np.int32)
    place[keep] = np.arange(len(keep))
    for y in range(len(links)):
        x = links[y, 1]
        while heir[x] >= 0:
            x = heir[x]
        links[y, 1] = place[x]
    return select(new, keep), links, True


@njit(cache=True)
def closings(labels, pieces, others):
    """Return (bound, cost) of closing each label with a flight home, infinite if it would come too late.

    others: least reduced cost of the other routes. cost is the route's reduced cost alone.
    """
    bound, cost = np.full(len(labels.left), np.inf), np.full(len(labels.left), np.inf)
    if others == np.inf:
        return bound, cost
    for x in range(len(labels.left)):
        q = labels.piece[x]
        start = max(0.0, labels.early[x] - pieces.a[q])
        home = earliest_meeting(
            pieces.p[q, 0] + start * pieces.v[q, 0], pieces.p[q, 1] + start * pieces.v[q, 1], pieces.a[q] + start,
            pieces.depot[0], pieces.depot[1], 0.0, 0.0, 0.0, 0.0, pieces.horizon, pieces.speed,
        )  # fmt: skip
        if home == np.inf:
            continue
        width = pieces.b[q] - pieces.a[q]
        left = labels.left[x] + pieces.last[q, 0]
        right = labels.right[x] + pieces.last[q, 0] + pieces.last[q, 1] * width
        cost[x] = _least(left, right, _share(labels.early[x], pieces.a[q], width))
        bound[x] = cost[x] + others
    return bound, cost
