"""ng-routes over pieces (Baldacci, Mingozzi and Roberti 2011): what it costs at least to go on from a piece.

An ng-route may repeat a target that it has forgotten: at target u it remembers only visits to members of the ng-set
N_u. It may also leave a piece at another time than it arrived. A value to go is an affine minorant, kept as its values
(left, right) at the two ends of the piece, of the reduced cost (length less the multiplier pi of each visit, and the
prices of subset-row cuts) of every real route's way from there to its end.

Values are kept in a list for each piece, one entry for each memory (set of targets that must not come before), parity
(of the subset-row cuts) and load (demand from there on), thinned by dominance. Pieces are handled from the last to the
first; a piece whose list changed marks those before it that were handled already (their flights go between overlapping
pieces), and passes go on until nothing changes: then the values hold for routes of any length. After as many passes as
there are targets they hold for all real routes in any case.

The same code runs forward in time: `reversed_side` shows it the instance with time running backward.
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled, inlined
from .legs import before_leg, least, share_before
from .sets import add, grown, has, same, subset

#: more entries than any list has
ALL_ENTRIES = 1 << 40
#: comparisons of entries between two looks at the clock
_AT_ONCE = 1_000_000_000


class Unfinished(Exception):
    """Values to go take more entries than there may be, or more time."""


class Side(NamedTuple):
    """The pieces and arcs as seen in one direction of time.

    order: (Q,) pieces, the last first; target, layer, a, width: (Q,); begin, end: (Q, 2) the legs from and to the depot
    at both ends of a piece; ready: (Q,) earliest time there; start, head, leg: as in Arcs; back_start, back: the tails
    of the arcs into each piece; speed, demand, room: as in Pieces.
    """

    order: np.ndarray
    target: np.ndarray
    layer: np.ndarray
    a: np.ndarray
    width: np.ndarray
    begin: np.ndarray
    end: np.ndarray
    ready: np.ndarray
    start: np.ndarray
    head: np.ndarray
    leg: np.ndarray
    back_start: np.ndarray
    back: np.ndarray
    speed: np.ndarray
    demand: np.ndarray
    room: np.ndarray


class Lists(NamedTuple):
    """Entries of each piece q: first[q] : first[q] + count[q] of memory (X, W), parity, load (the demand of the visits
    behind q), left and right, all (X,), in order of the sums of the last two."""

    first: np.ndarray
    count: np.ndarray
    memory: np.ndarray
    parity: np.ndarray
    load: np.ndarray
    left: np.ndarray
    right: np.ndarray


class Prices(NamedTuple):
    """What a relaxed route pays. pi: (n,) multipliers; N: (n, W) ng-sets; of subset-row cuts, as bits of a word, and
    sigma: (64,) their prices <= 0: inside: (n,) the cuts whose row each target is in, kept: (n,) those whose memory it
    is in."""

    pi: np.ndarray
    N: np.ndarray
    inside: np.ndarray
    kept: np.ndarray
    sigma: np.ndarray


def sides(pieces, arcs):
    """Return (side, reversed side) of the arcs between pieces."""
    width = pieces.b - pieces.a
    into, tail, leg = _mirrored(arcs.head, arcs.tail, arcs.leg, width)
    ahead = _side(
        pieces, pieces.a, pieces.first, pieces.last, pieces.ready, arcs.start, arcs.head, arcs.leg, into, tail
    )  # fmt: skip
    begin, end = np.ascontiguousarray(pieces.last[:, ::-1]), np.ascontiguousarray(pieces.first[:, ::-1])
    always = np.full(len(width), -np.inf)
    back = _side(pieces, -pieces.b, begin, end, always, into, tail, leg, arcs.start, arcs.head)
    return ahead, back


@compiled
def _mirrored(head, tail, leg, width):
    """Return (into, tail, leg) of the arcs by head, as seen backward in time: those into r in into[r]:into[r + 1]."""
    into, by_head, mirrored = np.zeros(len(width) + 1, np.int64), np.empty_like(tail), np.empty_like(leg)
    for k in range(len(head)):
        into[head[k] + 1] += 1
    into = np.cumsum(into)
    place = into.copy()
    for k in range(len(head)):
        q, r = tail[k], head[k]
        x = place[r]
        place[r] += 1
        by_head[x] = q
        mirrored[x, 0] = leg[k, 0] + leg[k, 1] * width[q] + leg[k, 2] * width[r]
        mirrored[x, 1], mirrored[x, 2] = -leg[k, 2], -leg[k, 1]
    return into, by_head, mirrored


def _side(pieces, a, begin, end, ready, start, head, leg, back_start, back):
    return Side(
        np.argsort(-a, kind="stable"), pieces.target, pieces.layer, a, pieces.b - pieces.a, begin, end, ready, start,
        head, leg, back_start, back, pieces.speed, pieces.demand, pieces.room,
    )  # fmt: skip


@compiled
def penalty(hits, sigma):
    """Return what the subset-row cuts with these bits cost, >= 0."""
    total = 0.0
    bit = 0
    while hits:
        if hits & np.uint64(1):
            total -= sigma[bit]
        hits >>= np.uint64(1)
        bit += 1
    return total


@inlined
def _pays(odd, sigma):
    """Return the penalty of the cuts in `odd`, most often none."""
    return penalty(odd, sigma) if odd else 0.0


@compiled
def _extended(q, side, prices, lists, work, first_time, most):
    """Gather in `work` (memory, parity, load, left, right) what can be said of piece q from the lists of those behind
    it: the entries that no other dominates, by their sums, the first `most` of them; return how many, -1 if there is no
    room.

    Everything is unpacked first and done in one loop: numba counts references at each call and attribute otherwise.
    """
    memory, parity, load, left, right = work
    first, count, old_memory, old_parity, old_load, old_left, old_right = lists
    target, a, width, head, leg, demand = side.target, side.a, side.width, side.head, side.leg, side.demand
    pi, N, inside, sigma = prices.pi, prices.N, prices.inside, prices.sigma
    W, room, known = N.shape[1], len(left), count[q]
    u, a_q, width_q, kept, layer = target[q], a[q], width[q], prices.kept[target[q]], side.layer[q]
    speed, room_q = side.speed[layer], side.room[layer] - demand[layer, u]
    fresh = np.zeros((1, W), np.uint64)
    if known > room:
        return -1
    for x in range(known):
        for z in range(W):
            memory[x, z] = old_memory[first[q] + x, z]
        parity[x], load[x] = old_parity[first[q] + x], old_load[first[q] + x]
        left[x], right[x] = old_left[first[q] + x], old_right[first[q] + x]
    begin = side.start[q] - 1 if first_time and side.end[q, 0] < np.inf else side.start[q]
    for k in range(begin, side.start[q + 1]):
        home = k < side.start[q]  # the leg to the depot comes first, then the arcs
        r = q if home else head[k]
        w = target[r]
        gap, pi_w, inside_w, width_r, known_w = a[r] - a_q, pi[w], inside[w], width[r], has(N, u, w)
        demand_w = demand[layer, w]
        for x in range(first[r], first[r] + (1 if home else count[r])):
            if home:
                low, high, odd, carried = side.end[q, 0], side.end[q, 1], np.uint64(0), 0.0
                for z in range(W):
                    fresh[0, z] = np.uint64(0)
            else:
                carried = old_load[x] + demand_w
                if has(old_memory, x, u) or carried > room_q:
                    continue
                if known == most:  # lists of few entries prove nothing: most of what will not be kept goes at once
                    rest = min(old_left[x], old_right[x] + leg[k, 2] * width_r) - pi_w
                    if 2.0 * (leg[k, 0] + rest) + leg[k, 1] * width_q >= left[most - 1] + right[most - 1]:
                        continue
                low, high = before_leg(
                    leg[k, 0], leg[k, 1], leg[k, 2], old_left[x], old_right[x], width_q, width_r, gap, speed
                )  # fmt: skip
                pay = _pays(old_parity[x] & inside_w, sigma) - pi_w
                low += pay
                high += pay
                odd = (old_parity[x] ^ inside_w) & kept
                for z in range(W):
                    fresh[0, z] = old_memory[x, z] & N[u, z]
                if known_w:
                    add(fresh, 0, w)
            total, y = low + high, 0
            while y < known and left[y] + right[y] <= total:
                if left[y] <= low and right[y] <= high and subset(memory, y, fresh, 0):
                    pay = _pays(parity[y] & ~odd, sigma)
                    if left[y] + pay <= low and right[y] + pay <= high and load[y] <= carried:
                        break
                y += 1
            if y < known and left[y] + right[y] <= total:
                continue  # dominated
            place, gone = y, 0
            while y < known:  # what the new entry dominates goes
                pay = np.inf
                if low <= left[y] and high <= right[y] and subset(fresh, 0, memory, y):
                    pay = _pays(odd & ~parity[y], sigma)
                if low + pay <= left[y] and high + pay <= right[y] and carried <= load[y]:
                    gone += 1
                elif gone:
                    for z in range(W):
                        memory[y - gone, z] = memory[y, z]
                    parity[y - gone], load[y - gone] = parity[y], load[y]
                    left[y - gone], right[y - gone] = left[y], right[y]
                y += 1
            known -= gone
            if known == most:
                if place == most:
                    continue
                known -= 1
            if known == room:
                return -1
            for y in range(known, place, -1):
                for z in range(W):
                    memory[y, z] = memory[y - 1, z]
                parity[y], load[y], left[y], right[y] = parity[y - 1], load[y - 1], left[y - 1], right[y - 1]
            for z in range(W):
                memory[place, z] = fresh[0, z]
            parity[place], load[place], left[place], right[place] = odd, carried, low, high
            known += 1
    return known


@compiled
def _room(size, W):
    return np.empty((size, W), np.uint64), np.empty(size, np.uint64), np.empty(size), np.empty(size), np.empty(size)


def values_to_go(side, prices, tolerance, most_passes, few, most, out):
    """Return (Lists, extensions): values to go of each piece, its own multiplier not included, and how many extensions
    of entries along arcs they took; raise Unfinished if a list needs room for more than `most` entries, or out() tells
    that time is up.

    tolerance: a change of a value that counts as none; few: entries of a list that are kept, ALL_ENTRIES for all: with
    fewer than there are the values are those of some ng-routes, and bound nothing.
    """
    so_far = _begun(len(side.a), prices.N.shape[1], most)
    while so_far.visits < most_passes * len(side.a) and so_far.dirty.any():
        so_far, fits = _continued(side, prices, tolerance, few, most, so_far)
        if not fits or out():
            raise Unfinished
    return so_far.lists, so_far.extensions


class _SoFar(NamedTuple):
    """Lists after so many visits to pieces, pass after pass in order of time, and so many extensions of entries along
    arcs; the first `used` entries are in use; dirty: (Q,) pieces to whose lists more may come; work: room for one list.
    """

    lists: Lists
    used: int
    visits: int
    extensions: int
    dirty: np.ndarray
    work: tuple


@compiled
def _begun(Q, W, most):
    size = 4 * Q + 64
    lists = Lists(
        np.zeros(Q, np.int64), np.zeros(Q, np.int64), np.empty((size, W), np.uint64), np.empty(size, np.uint64),
        np.empty(size), np.empty(size), np.empty(size),
    )  # fmt: skip
    return _SoFar(lists, np.int64(0), np.int64(0), np.int64(0), np.ones(Q, np.bool_), _room(min(256, most), W))


@compiled
def _continued(side, prices, tolerance, few, most, so_far):
    """Return (_SoFar, whether `most` entries were room enough) after some tenths of a second, or a pass."""
    lists, used, visits, extensions, dirty, work = so_far
    Q, W, effort = len(side.a), prices.N.shape[1], 0
    first_time = visits < Q
    while effort < _AT_ONCE:
        q = side.order[visits % Q]
        visits += 1
        if dirty[q]:
            dirty[q] = False
            known = _extended(q, side, prices, lists, work, first_time, few)
            while known < 0:
                if len(work[2]) >= most:
                    return _SoFar(lists, used, visits, extensions, dirty, work), False
                work = _room(min(4 * len(work[2]), most), W)
                known = _extended(q, side, prices, lists, work, first_time, few)
            extensions += _entries_ahead(side.head, lists.count, side.start[q], side.start[q + 1])
            effort += known * known * (side.start[q + 1] - side.start[q])
            if not _unchanged(work, known, lists, q, tolerance):
                if known > lists.count[q]:
                    if used + known > len(lists.left):
                        lists = Lists(
                            lists.first, lists.count,
                            *grown(lists.memory, lists.parity, lists.load, lists.left, lists.right, used, known),
                        )  # fmt: skip
                    lists.first[q] = used
                    used += known
                _store(work, known, lists, q)
                _mark(side.back, dirty, side.back_start[q], side.back_start[q + 1])
        if visits % Q == 0:
            break
    return _SoFar(lists, used, visits, extensions, dirty, work), True


@compiled
def _entries_ahead(head, count, begin, end):
    total = 0
    for k in range(begin, end):
        total += count[head[k]]
    return total


@compiled
def _mark(back, dirty, begin, end):
    for k in range(begin, end):
        dirty[back[k]] = True


@compiled
def _store(work, known, lists, q):
    """Make the first `known` entries the list of piece q."""
    memory, parity, load, left, right = work
    lists.count[q] = known
    for x in range(known):
        y = lists.first[q] + x
        for z in range(memory.shape[1]):
            lists.memory[y, z] = memory[x, z]
        lists.parity[y], lists.load[y], lists.left[y], lists.right[y] = parity[x], load[x], left[x], right[x]


@compiled
def _unchanged(work, known, lists, q, tolerance):
    memory, parity, load, left, right = work
    if known != lists.count[q]:
        return False
    for x in range(known):
        y = lists.first[q] + x
        if parity[x] != lists.parity[y] or load[x] != lists.load[y] or not same(memory, x, lists.memory, y):
            return False
        if left[x] < lists.left[y] - tolerance or right[x] < lists.right[y] - tolerance:
            return False
    return True


@compiled
def cheapest_starts(side, prices, lists):
    """Return (cost, entry), each (Q,): the least reduced cost of an ng-route that begins at each piece, and the first
    entry of its list on it; infinite and -1 where there is none."""
    Q = len(side.a)
    cost, entry = np.full(Q, np.inf), np.full(Q, -1)
    for q in range(Q):
        if side.begin[q, 0] == np.inf:
            continue
        u = side.target[q]
        share = share_before(side.ready[q], side.a[q], side.width[q])
        for x in range(lists.first[q], lists.first[q] + lists.count[q]):
            pay = penalty(lists.parity[x] & prices.inside[u], prices.sigma) - prices.pi[u]
            value = pay + least(side.begin[q, 0] + lists.left[x], side.begin[q, 1] + lists.right[x], share)
            if value < cost[q]:
                cost[q], entry[q] = value, x
    return cost, entry


@compiled
def trace(side, prices, lists, q, x, longest):
    """Return the pieces of a cheapest ng-route from piece q on that begins with entry x of its list; the first
    `longest` of them if it has as many: it then goes round and round between pieces that overlap in time."""
    W = prices.N.shape[1]
    route, length = np.empty(longest, np.int64), 0
    fresh = np.zeros((1, W), np.uint64)
    while length < longest:
        route[length] = q
        length += 1
        u, layer = side.target[q], side.layer[q]
        best, best_k, best_x = np.inf, -1, -1
        if side.end[q, 0] < np.inf:
            best = max(side.end[q, 0] - lists.left[x], side.end[q, 1] - lists.right[x])
        for k in range(side.start[q], side.start[q + 1]):
            r = side.head[k]
            w = side.target[r]
            for y in range(lists.first[r], lists.first[r] + lists.count[r]):
                odd = (lists.parity[y] ^ prices.inside[w]) & prices.kept[u]
                if has(lists.memory, y, u) or odd & ~lists.parity[x]:
                    continue
                low, high = before_leg(
                    side.leg[k, 0], side.leg[k, 1], side.leg[k, 2], lists.left[y], lists.right[y], side.width[q],
                    side.width[r], side.a[r] - side.a[q], side.speed[layer],
                )  # fmt: skip
                pay = penalty(lists.parity[y] & prices.inside[w], prices.sigma) - prices.pi[w]
                off = max(low + pay - lists.left[x], high + pay - lists.right[x])
                if off >= best:
                    continue
                for z in range(W):
                    fresh[0, z] = lists.memory[y, z] & prices.N[u, z]
                if has(prices.N, u, w):
                    add(fresh, 0, w)
                if subset(fresh, 0, lists.memory, x) and lists.load[y] + side.demand[layer, w] <= lists.load[x]:
                    best, best_k, best_x = off, k, y
        if best_k < 0:
            return route[:length]
        q, x = side.head[best_k], best_x
    return route


@compiled
def value_along(side, prices, route):
    """Return (left, right): the values to go at the first piece of a route of pieces, with what its own visit pays of
    the subset-row cuts."""
    pay, odd = 0.0, np.uint64(0)
    left, right = side.end[route[-1]]
    for i in range(len(route) - 1, -1, -1):
        q = route[i]
        u = side.target[q]
        if i < len(route) - 1:
            r = route[i + 1]
            for k in range(side.start[q], side.start[q + 1]):
                if side.head[k] == r:
                    left, right = before_leg(
                        side.leg[k, 0], side.leg[k, 1], side.leg[k, 2], left, right, side.width[q], side.width[r],
                        side.a[r] - side.a[q], side.speed[side.layer[q]],
                    )  # fmt: skip
                    break
            left += pay
            right += pay
        odd &= prices.kept[u]
        pay = penalty(odd & prices.inside[u], prices.sigma) - (prices.pi[u] if i > 0 else 0.0)
        odd ^= prices.inside[u]
    return left + pay, right + pay
