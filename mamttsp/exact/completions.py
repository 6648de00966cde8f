"""What it costs at least to complete a label, at the prices of several evaluations at once.

Each evaluation proves on its own which labels no completion keeps within the limit, and other prices prove it of
others: where the relaxation leaves a wide gap, two dozen of them leave a tenth of the labels.
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled, inlined
from .legs import least
from .ngroutes import penalty
from .sets import disjoint, has


class Completions(NamedTuple):
    """Values to go at the multipliers pi (K, n) of K evaluations of one network, which has the same cuts at the same
    prices in all of them, if any.

    limit: (K, layers) the greatest reduced cost of a route; inside: (n,), sigma: (64,) as in `ngroutes.Prices`; best:
    (Q, K, 2) the least value to go at both ends of a piece, whatever is remembered; span: (Q, K, 2) its entries, of
    value (X, 3), at the left, at the right and the lesser of both, by which they are in order, and memory (X, W),
    parity and load (X,) as in `ngroutes.Lists`.
    """

    pi: np.ndarray
    limit: np.ndarray
    inside: np.ndarray
    sigma: np.ndarray
    best: np.ndarray
    span: np.ndarray
    value: np.ndarray
    memory: np.ndarray
    parity: np.ndarray
    load: np.ndarray


def completions_of(evaluations, limit):
    """Return the Completions of routes of a solution of value at most `limit`."""
    prices = evaluations[0].prices
    span, best, *entries = zip(*(_gathered(e.lists) for e in evaluations))
    before = np.cumsum([0, *map(len, entries[0])])
    return Completions(
        np.array([e.pi for e in evaluations]),
        np.array([e.slack(limit) for e in evaluations]),
        prices.inside,
        prices.sigma,
        np.stack(best, axis=1),
        np.stack([own + start for own, start in zip(span, before)], axis=1),
        *map(np.concatenate, entries),
    )


def _gathered(lists):
    """Return (span (Q, 2), best (Q, 2), value, memory, parity, load) of one evaluation's Lists."""
    end = np.cumsum(lists.count)
    piece = np.repeat(np.arange(len(end)), lists.count)
    entry = np.arange(len(piece)) + (lists.first - end + lists.count)[piece]
    value = np.c_[lists.left, lists.right, np.minimum(lists.left, lists.right)][entry]
    order = np.lexsort((value[:, 2], piece))
    value, entry, best = value[order], entry[order], np.full((len(end), 2), np.inf)
    np.minimum.at(best, piece, value[:, :2])
    span = np.c_[end - lists.count, end]
    return span, best, value, lists.memory[entry], lists.parity[entry], lists.load[entry]


@compiled
def shifts(visited, x, pi, shift):
    """Write to shift (K,) how much more the visits to set x cost at each of the prices than at the first."""
    shift[:] = 0.0
    for u in range(pi.shape[1]):
        if has(visited, x, u):
            for k in range(1, len(shift)):
                shift[k] += pi[0, u] - pi[k, u]


@inlined
def promising(left, right, r, layer, w, shift, turn, pi, limit, best):
    """Tell whether at each of the prices the least values to go at piece r keep a label there within the limit.

    left, right: its reduced cost at the first prices; w: its last target, shift: (K,) of those before, see `shifts`;
    turn: (K,) the order in which prices are asked: those that say no move forward.
    """
    fits = True
    for i in range(len(turn)):
        k = turn[i]
        more = shift[k] + pi[0, w] - pi[k, w]
        if min(left + best[r, k, 0], right + best[r, k, 1]) + more > limit[k, layer]:
            fits = False
            if i > 0:
                turn[i], turn[i - 1] = turn[i - 1], k
            break
    return fits


@inlined
def completed(
    visited, odd, room, left, right, share, r, layer, w, shift, turn, pi, limit, sigma, span, value, memory, parity,
    load,
):  # fmt: skip
    """Tell whether at each of the prices an entry of the values to go at piece r keeps a label there within the limit.

    visited: (1, W) its set; odd: the cuts of whose rows that has an odd number; room: what it can still carry; share:
    of the piece, from 0 to 1, that passes before it can be there; the rest as in `promising`.
    """
    lesser, fits = min(left, right), True
    for i in range(len(turn)):
        k = turn[i]
        more, allowed, found = shift[k] + pi[0, w] - pi[k, w], limit[k, layer], False
        for y in range(span[r, k, 0], span[r, k, 1]):
            if lesser + value[y, 2] + more > allowed:
                break  # nor do any of the others
            low, high = left + more + value[y, 0], right + more + value[y, 1]
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
            fits = False
            break
    return fits
