"""Relaxed routes: dynamic programs over (number of visits, piece, ng-memory) whose values are affine on each piece.

A relaxed route may leave a piece at another time than it arrived, and may repeat targets that it has forgotten. The
value of a state is an affine minorant, kept as its values (left, right) at the two ends of the piece, of the reduced
cost (length less the multiplier pi of each visit) of every real route through it. Three things make that tight:
tangent planes of the legs (second order, `pieces`), values that are affine and not constant in time (the slope plays
the part of a time price), and the speed limit, taken into each leg with its best Lagrange multiplier eta >= 0:
d <= v (t_r - t_q) implies d >= (1 + eta) d - eta v (t_r - t_q), and the right side is affine below.
"""

import numpy as np
from numba import njit


@njit(cache=True, inline="always")
def before_leg(c, slope_q, slope_r, left, right, width_q, width_r, gap, speed, per_width, per_speed):
    """Return (left, right) at q of: leg from q to r, then a value (left, right) at r. gap: a_r - a_q in s.

    per_width: 1 / width_r, 0 for a width of 0; per_speed: 1 / (speed - slope_r).
    """
    if per_width == 0.0:
        value = c + min(left, right)
        return value, value + slope_q * width_q
    rise = slope_r + (right - left) * per_width
    if rise <= 0.0:  # best at the end of r, where time is no obstacle
        value = c + left + rise * width_r
        return value, value + slope_q * width_q
    eta = rise * per_speed
    free, rise_free = c + left, slope_q * width_q
    held = free + eta * (c - speed * gap)
    rise_held = rise_free + eta * (slope_q + speed) * width_q
    if 2.0 * held + rise_held > 2.0 * free + rise_free:
        return held, held + rise_held
    return free, free + rise_free


@njit(cache=True)
def after_leg(c, slope_q, slope_r, left, right, width_q, width_r, gap, speed, start, share):
    """Return (left, right) at r of: a value (left, right) at q, then the leg from q to r. gap: a_r - a_q in s.

    start: time since a_q before which the agent cannot leave; share: the part of r, from 0 to 1, that passes before it
    can arrive. Both only help to choose the better of two valid bounds.
    """
    price = (right - left) / width_q if width_q > 0.0 else -slope_q
    rise = price + slope_q
    if rise >= 0.0:  # best as soon as it can leave
        value = c + left + rise * start
        return value, value + slope_r * width_r
    free = c + left + rise * width_q
    rise_free = slope_r * width_r
    eta = -rise / (slope_q + speed)
    held = left + (1.0 + eta) * c - eta * speed * gap
    rise_held = ((1.0 + eta) * slope_r - eta * speed) * width_r
    middle = 0.5 * (1.0 + share)
    if held + rise_held * middle > free + rise_free * middle:
        return held, held + rise_held
    return free, free + rise_free


@njit(cache=True)
def backward(pieces, pi, move, alive, value, best, count, index):
    """Fill the values to go: state (k, q, mask) is at q, has k more visits to make, then flies home.

    alive: (K, Q) states that may be part of a better solution. value: (K, Q, M, 2); best: (K, Q, M, 2) the next piece
    and memory of the cheapest extension; count: (K, Q) and index: (K, Q, M) list the memories that occur.
    """
    K, Q, M, _ = value.shape
    value[:] = np.inf
    count[:] = 0
    for q in range(Q):
        if alive[0, q] and pieces.last[q, 0] < np.inf:
            value[0, q, 0, 0] = pieces.last[q, 0]
            value[0, q, 0, 1] = pieces.last[q, 0] + pieces.last[q, 1] * (pieces.b[q] - pieces.a[q])
            count[0, q] = 1
            index[0, q, 0] = 0
    cheapest = np.empty(M)
    for k in range(1, K):
        for q in range(Q):
            if not alive[k, q]:
                continue
            cheapest[:] = np.inf
            for r in range(Q):
                if count[k - 1, r] > 0 and pieces.legs[q, r, 0] < np.inf:
                    _extend_backward(pieces, pi, move, value, best, count, index, cheapest, k, q, r)
            for mask in range(M):
                if cheapest[mask] < np.inf:
                    index[k, q, count[k, q]] = mask
                    count[k, q] += 1


@njit(cache=True, inline="always")
def _extend_backward(pieces, pi, move, value, best, count, index, cheapest, k, q, r):
    u, w = pieces.target[q], pieces.target[r]
    width_q, width_r = pieces.b[q] - pieces.a[q], pieces.b[r] - pieces.a[r]
    gap = pieces.a[r] - pieces.a[q]
    c, slope_q, slope_r = pieces.legs[q, r, 0], pieces.legs[q, r, 1], pieces.legs[q, r, 2]
    per_width = 1.0 / width_r if width_r > 0.0 else 0.0
    per_speed = 1.0 / (pieces.speed - slope_r)
    for z in range(count[k - 1, r]):
        mask = index[k - 1, r, z]
        memory = move[w, u, mask]
        if memory < 0:
            continue
        left, right = before_leg(
            c, slope_q, slope_r, value[k - 1, r, mask, 0], value[k - 1, r, mask, 1], width_q, width_r, gap,
            pieces.speed, per_width, per_speed,
        )  # fmt: skip
        left -= pi[w]
        right -= pi[w]
        value[k, q, memory, 0] = min(value[k, q, memory, 0], left)
        value[k, q, memory, 1] = min(value[k, q, memory, 1], right)
        if left + right < cheapest[memory]:
            cheapest[memory] = left + right
            best[k, q, memory, 0] = r
            best[k, q, memory, 1] = mask


@njit(cache=True)
def forward(pieces, pi, move, alive, value, count, index):
    """Fill the values so far: state (s, q, mask) has come from the depot, made s visits, the last at q.

    alive: (n + 1, Q); value: (n + 1, Q, M, 2); count, index: as in `backward`.
    """
    S, Q, M, _ = value.shape
    value[:] = np.inf
    count[:] = 0
    for q in range(Q):
        if alive[1, q] and pieces.first[q, 0] < np.inf:
            left = pieces.first[q, 0] - pi[pieces.target[q]]
            value[1, q, 0, 0] = left
            value[1, q, 0, 1] = left + pieces.first[q, 1] * (pieces.b[q] - pieces.a[q])
            count[1, q] = 1
            index[1, q, 0] = 0
    for s in range(2, S):
        for r in range(Q):
            if not alive[s, r]:
                continue
            for q in range(Q):
                if count[s - 1, q] > 0 and pieces.legs[q, r, 0] < np.inf:
                    _extend_forward(pieces, pi, move, value, count, index, s, q, r)
            for mask in range(M):
                if value[s, r, mask, 0] < np.inf:
                    index[s, r, count[s, r]] = mask
                    count[s, r] += 1


@njit(cache=True, inline="always")
def _extend_forward(pieces, pi, move, value, count, index, s, q, r):
    u, w = pieces.target[q], pieces.target[r]
    width_q, width_r = pieces.b[q] - pieces.a[q], pieces.b[r] - pieces.a[r]
    gap = pieces.a[r] - pieces.a[q]
    c, slope_q, slope_r = pieces.legs[q, r, 0], pieces.legs[q, r, 1], pieces.legs[q, r, 2]
    for z in range(count[s - 1, q]):
        mask = index[s - 1, q, z]
        memory = move[u, w, mask]
        if memory < 0:
            continue
        left, right = after_leg(
            c, slope_q, slope_r, value[s - 1, q, mask, 0], value[s - 1, q, mask, 1],
            width_q, width_r, gap, pieces.speed, 0.0, 0.0,
        )  # fmt: skip
        value[s, r, memory, 0] = min(value[s, r, memory, 0], left - pi[w])
        value[s, r, memory, 1] = min(value[s, r, memory, 1], right - pi[w])


@njit(cache=True)
def cheapest_routes(pieces, pi, value, count, index, n):
    """Return (cost, start): the least reduced cost of a relaxed route of k + 1 visits whose first is target u, (K,
    n), and its first state, (K, n, 2) piece and memory; infinite where there is none."""
    K, Q = count.shape
    cost = np.full((K, n), np.inf)
    start = np.full((K, n, 2), -1)
    for k in range(K):
        for q in range(Q):
            if pieces.first[q, 0] == np.inf:
                continue
            u = pieces.target[q]
            width = pieces.b[q] - pieces.a[q]
            share = max(0.0, pieces.ready[q] - pieces.a[q]) / width if width > 0.0 else 0.0
            for z in range(count[k, q]):
                mask = index[k, q, z]
                left = pieces.first[q, 0] + value[k, q, mask, 0] - pi[u]
                right = left + pieces.first[q, 1] * width + value[k, q, mask, 1] - value[k, q, mask, 0]
                least = min(left + (right - left) * share, right)
                if least < cost[k, u]:
                    cost[k, u] = least
                    start[k, u, 0] = q
                    start[k, u, 1] = mask
    return cost, start


@njit(cache=True)
def trace(pieces, best, start, lengths, firsts, n):
    """Return (J, n): how often the cheapest route with lengths[j] more visits after first target firsts[j] visits
    each."""
    visits = np.zeros((len(lengths), n))
    for j in range(len(lengths)):
        q, mask = start[lengths[j], firsts[j]]
        visits[j, pieces.target[q]] += 1.0
        for k in range(lengths[j], 0, -1):
            q, mask = best[k, q, mask]
            visits[j, pieces.target[q]] += 1.0
    return visits


@njit(cache=True)
def completions(value, memory_bits):
    """Return `value` (K, Q, M, 2) with each mask replaced by the least value over memories disjoint from it."""
    K, Q, M, _ = value.shape
    least = np.full((K, Q, M, 2), np.inf)
    for k in range(K):
        for q in range(Q):
            for mask in range(M):
                for side in range(2):
                    least[k, q, M - 1 - mask, side] = value[k, q, mask, side]
            for bit in range(memory_bits):
                for mask in range(M):
                    if not mask >> bit & 1:
                        for side in range(2):
                            other = least[k, q, mask | 1 << bit, side]
                            if other < least[k, q, mask, side]:
                                least[k, q, mask, side] = other
    return least


@njit(cache=True)
def completions_with_rest(to_go, rest):
    """Return (n + 1, Q, M, 2): the least cost to complete a route with s visits, and to serve all others by other
    routes.

    to_go: (K, Q, M, 2) from `completions`; rest: (n + 1,) least reduced cost of the other agents' routes with that many
    visits in all.
    """
    K, Q, M, _ = to_go.shape
    n = len(rest) - 1
    total = np.full((n + 1, Q, M, 2), np.inf)
    for s in range(1, n + 1):
        for k in range(min(K, n - s + 1)):
            if rest[n - s - k] < np.inf:
                total[s] = np.minimum(total[s], to_go[k] + rest[n - s - k])
    return total


@njit(cache=True)
def still_alive(so_far, count, index, to_go, rest, limit):
    """Return (after, before): which (s, q) and which (k, q) lie on some relaxed solution of value at most `limit`."""
    S, Q, M, _ = so_far.shape
    K = len(to_go)
    n = S - 1
    after, before = np.zeros((S, Q), np.bool_), np.zeros((K, Q), np.bool_)
    for s in range(1, S):
        for k in range(min(K, n - s + 1)):
            others = rest[n - s - k]
            if others == np.inf:
                continue
            for q in range(Q):
                for z in range(count[s, q]):
                    mask = index[s, q, z]
                    left = so_far[s, q, mask, 0] + to_go[k, q, mask, 0]
                    right = so_far[s, q, mask, 1] + to_go[k, q, mask, 1]
                    if min(left, right) + others <= limit:
                        after[s, q] = True
                        before[k, q] = True
                        break
    return after, before
