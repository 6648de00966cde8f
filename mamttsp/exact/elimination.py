"""Elimination by reduced cost: arcs that no solution within the limit can use."""

import numpy as np

from ..compiled import compiled
from .legs import before_leg
from .ngroutes import penalty
from .sets import disjoint, has


@compiled
def arcs_alive(side, prices, lists, back, slack):
    """Return (A,) bool: the arcs on some relaxed route of reduced cost at most slack[k] in layer k.

    lists: values to go; back: values of the other direction, with its own order of ends.
    """
    alive = np.zeros(len(side.head), np.bool_)
    pi, inside, kept, sigma = prices.pi, prices.inside, prices.kept, prices.sigma
    target, a, width, start, head, leg, demand = (
        side.target, side.a, side.width, side.start, side.head, side.leg, side.demand
    )  # fmt: skip
    for q in range(len(a)):
        u, layer = target[q], side.layer[q]
        speed, allowed = side.speed[layer], slack[layer]
        begin, end = back.first[q], back.first[q] + back.count[q]
        if begin == end:
            continue
        best_left, best_right = np.min(back.right[begin:end]), np.min(back.left[begin:end])
        for k in range(start[q], start[q + 1]):
            r = head[k]
            w = target[r]
            room = side.room[layer] - demand[layer, u] - demand[layer, w]
            for y in range(lists.first[r], lists.first[r] + lists.count[r]):
                if alive[k]:
                    break
                if has(lists.memory, y, u):
                    continue
                low, high = before_leg(
                    leg[k, 0], leg[k, 1], leg[k, 2], lists.left[y], lists.right[y], width[q], width[r], a[r] - a[q],
                    speed,
                )  # fmt: skip
                hits = lists.parity[y] & inside[w]
                pay = -pi[w] - pi[u] + (penalty(hits, sigma) if hits else 0.0)
                low += pay
                high += pay
                if min(best_left + low, best_right + high) > allowed:
                    continue
                odd = (lists.parity[y] ^ inside[w]) & kept[u]
                for x in range(begin, end):
                    if min(back.right[x] + low, back.left[x] + high) > allowed or back.load[x] + lists.load[y] > room:
                        continue
                    if has(back.memory, x, w) or not disjoint(back.memory, x, lists.memory, y):
                        continue
                    # Of the counts before, at and behind q two odd ones make a pair.
                    pairs = (odd & inside[u]) | (odd & back.parity[x]) | (inside[u] & back.parity[x])
                    more = penalty(pairs, sigma) if pairs else 0.0
                    if min(back.right[x] + low, back.left[x] + high) + more <= allowed:
                        alive[k] = True
                        break
    return alive
