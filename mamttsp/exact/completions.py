"""What it costs at least to complete a label, at the prices of several evaluations at once.

Each evaluation proves on its own which labels no completion keeps within the limit, and other prices prove it of
others: where the relaxation leaves a wide gap, a dozen of them leave a tenth of the labels.
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled
from .legs import least
from .ngroutes import Lists, penalty
from .sets import disjoint, has


class Completions(NamedTuple):
    """Values to go at the multipliers pi (K, n) of K evaluations of one network, which has the same cuts at the same
    prices in all of them, if any.

    limit: (K, layers) the greatest reduced cost of a route; inside: (n,), sigma: (64,) as in `ngroutes.Prices`; lists:
    the Lists of all evaluations, one behind the other, with first and count (K, Q); best: (K, Q, 2) the least value to
    go at both ends, whatever is remembered.
    """

    pi: np.ndarray
    limit: np.ndarray
    inside: np.ndarray
    sigma: np.ndarray
    lists: Lists
    best: np.ndarray


def completions_of(evaluations, limit):
    """Return the Completions of routes of a solution of value at most `limit`."""
    lists, prices = [e.lists for e in evaluations], evaluations[0].prices
    offset = np.cumsum([0] + [len(own.left) for own in lists])
    first = np.array([own.first + start for own, start in zip(lists, offset)])
    count = np.array([own.count for own in lists])
    together = Lists(first, count, *map(np.concatenate, zip(*(own[2:] for own in lists))))
    return Completions(
        np.array([e.pi for e in evaluations]),
        np.array([e.slack(limit) for e in evaluations]),
        prices.inside,
        prices.sigma,
        together,
        np.array([_best(own) for own in lists]),
    )


@compiled
def _best(lists):
    """Return (Q, 2) the least values to go at both ends of each piece."""
    best = np.full((len(lists.first), 2), np.inf)
    for q in range(len(best)):
        for y in range(lists.first[q], lists.first[q] + lists.count[q]):
            best[q, 0] = min(best[q, 0], lists.left[y])
            best[q, 1] = min(best[q, 1], lists.right[y])
    return best


@compiled
def shifts(visited, x, pi, shift):
    """Write to shift (K,) how much more the visits to set x cost at each of the prices than at the first."""
    shift[:] = 0.0
    for u in range(pi.shape[1]):
        if has(visited, x, u):
            for k in range(1, len(shift)):
                shift[k] += pi[0, u] - pi[k, u]


@compiled
def completed(visited, odd, room, left, right, share, r, layer, w, shift, turn, completions):
    """Tell whether at each of the prices an entry of the values to go at piece r keeps a label there within the limit.

    visited: (1, W) its set; odd: the cuts of whose rows that has an odd number; room: what it can still carry; left,
    right: its reduced cost at the first prices; w: its last target, shift: (K,) of those before, see `shifts`; turn:
    (K,) the order in which prices are asked: those that say no move forward.
    """
    pi, limit, _, sigma, lists, best = completions
    first, count, memory, parity, load, to_go_left, to_go_right = lists
    for i in range(len(turn)):
        k = turn[i]
        more, allowed, found = shift[k] + pi[0, w] - pi[k, w], limit[k, layer], False
        end = first[k, r] + count[k, r]
        if min(left + more + best[k, r, 0], right + more + best[k, r, 1]) > allowed:
            end = first[k, r]  # none of them
        for y in range(first[k, r], end):
            low, high = left + more + to_go_left[y], right + more + to_go_right[y]
            if min(low, high) > allowed or load[y] > room or not disjoint(visited, 0, memory, y):
                continue
            hits = odd & parity[y]
            pay = penalty(hits, sigma) if hits else 0.0
            if pay + least(low, high, share) <= allowed:
                found = True
                break
        if not found:
            if i > 0:
                turn[i], turn[i - 1] = turn[i - 1], k
            return False
    return True
