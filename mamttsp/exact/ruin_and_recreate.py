"""First tours: ruin and recreate (after Christiaens and Vanden Berghe 2020).

Costs are those of visits on a time grid (see `grid`); what can be flown is told by exact times (see `reach`).
"""

import math
from collections import namedtuple

import numpy as np

from ..compiled import compiled
from .grid import Values, evaluate, grid_points, least_sum, make_networks, min_plus, of_layer, stop, trace
from .reach import fits, segments_of

#: What a ruin takes out, see `parameters.Parameters`: `removed` targets on average, of one route no more than `string`;
#: `radial`: how often they are the closest ones; blink: how often a place is overlooked; heat: of annealing at first
Ruins = namedtuple("Ruins", "removed string radial blink heat")


class Annealing:
    """Ruin and recreate by simulated annealing, from nothing or on from where it stands. Deterministic for a seed."""

    def __init__(self, graph, targets, fleet, parameters, seed=0):
        p = parameters
        self.m, self.n, self.seed, self.penalty = fleet.n_agents, len(targets), seed, p.left_out * (graph.size or 1.0)
        self.ruins = Ruins(p.removed, p.string, p.radial, p.blink, p.heat)
        points = grid_points(graph, targets, p.grid)
        self.networks = make_networks(graph, targets, points, p.grid_slack, p.grid_charges)
        self.order = _closeness(self.networks[0].near[:, :-1, :-1])
        self.nodes = np.concatenate([segments_of(graph, u) for u in targets])
        self.layer = np.repeat(np.arange(len(fleet.counts)), fleet.counts)
        self.loads = self.layer, graph.demands[list(targets)], graph.room
        self.first_node = graph.starts[self.layer]
        self.routes, self.length = np.zeros((self.m, self.n), np.int64), np.zeros(self.m, np.int64)

    def run(self, iterations, warm, cool):
        """Anneal on, from heat `warm` to `cool` (1 to 0); return routes (tuples of segments) that serve all targets
        and can be flown, or None while there are none."""
        self.seed += 1
        self.routes, self.length, length, segments = ruin_and_recreate(
            self.networks[self.seed % len(self.networks)],
            self.order,
            *self.loads,
            self.routes,
            self.length,
            self.penalty,
            self.ruins,
            iterations,
            warm,
            cool,
            self.seed,
        )
        if length.sum() < self.n:
            return None
        nodes = self.nodes[segments] + self.first_node[:, None]
        return [tuple(nodes[k, : length[k]].tolist()) for k in range(self.m) if length[k]]


@compiled
def _place(w, routes, length, cost, networks, values, layer, demand, room, blink, arrive, leave):
    """Return (k, i): the cheapest place to insert w, before stop i of route k; k = -1 if there is none."""
    places, bound = _places(w, routes, length, cost, networks, values, layer, demand, room, blink)
    best, best_k, best_i = np.inf, -1, -1
    while len(bound):
        place = np.argmin(bound)
        if bound[place] >= best:
            break
        bound[place], k, i = np.inf, places[place, 0], places[place, 1]
        (between, back, start, near, _, motion), here, rest = networks[k], values[k], length[k] - i
        before, behind, cutoff = stop(routes[k], length[k], i - 1), stop(routes[k], length[k], i), best + cost[k]
        if not fits(w, behind, here.early, i, here.late, rest, motion):
            continue
        least_to_go = near[w, behind] + here.least_to_go[rest]
        if min_plus(here.so_far, i, before, w, start, between, arrive, 0) + least_to_go >= cutoff:
            continue
        min_plus(here.to_go, rest, behind, w, start, back, leave, 0)
        total = least_sum(arrive, 0, leave, 0, start[w + 1] - start[w])
        if total < cutoff:
            best, best_k, best_i = total - cost[k], k, i
    return best_k, best_i


@compiled
def _places(w, routes, length, cost, networks, values, layer, demand, room, blink):
    """Return (places (P, 2), bound (P,)): routes and stops before which w might be inserted, and at least what that
    costs, from shortest flights."""
    places, bound = np.empty((len(length) + routes.shape[1], 2), np.int64), np.empty(len(length) + routes.shape[1])
    size, seen_empty = 0, -1
    for k in range(len(length)):
        if length[k] == 0:
            if seen_empty == layer[k]:  # one like it
                continue
            seen_empty = layer[k]
        if demand[w] + _load(routes[k], length[k], demand) > room[layer[k]]:
            continue
        near, here = networks[k].near, values[k]
        for i in range(length[k] + 1):
            before, behind = stop(routes[k], length[k], i - 1), stop(routes[k], length[k], i)
            least = here.least_so_far[i] + near[before, w] + near[w, behind] + here.least_to_go[length[k] - i]
            if least < np.inf and np.random.random() >= blink:
                places[size, 0], places[size, 1], bound[size] = k, i, least - cost[k]
                size += 1
    return places[:size], bound[:size]


@compiled
def _load(route, length, demand):
    total = 0.0
    for i in range(length):
        total += demand[route[i]]
    return total


@compiled
def _insert_all(bank, routes, length, cost, networks, values, layer, demand, room, blink, arrive, leave):
    """Insert each target of the bank at its cheapest place; return those for which there is none."""
    left = 0
    for w in bank:
        k, i = _place(w, routes, length, cost, networks, values, layer, demand, room, blink, arrive, leave)
        if k < 0:
            bank[left] = w
            left += 1
            continue
        for j in range(length[k], i, -1):
            routes[k, j] = routes[k, j - 1]
        routes[k, i] = w
        length[k] += 1
        cost[k] = evaluate(routes[k], length[k], networks[k], values[k], i, length[k] - 1 - i)
    return bank[:left].copy()


def _closeness(near):
    """Return (n, n): each target and behind it the others, closest first; near: (K, n, n) shortest flights' lengths."""
    close = np.minimum(near, near.transpose(0, 2, 1)).min(axis=0)
    np.fill_diagonal(close, -1.0)
    return np.argsort(close, axis=1, kind="stable")


@compiled
def _remove(seed, order, routes, length, absent, ruins):
    """Take strings of neighbouring stops out of routes that come close to the seed target, or the targets closest to
    it; return them, together with `absent`, shuffled."""
    m, n = routes.shape
    out = np.zeros(n, np.bool_)
    for w in absent:
        out[w] = True
    if np.random.random() < ruins.radial:
        for w in order[seed, : int(np.random.uniform(1.0, min(2.0 * ruins.removed, n) + 1.0))]:
            out[w] = True
    else:
        _mark_strings(order[seed], routes, length, max(1.0, min(ruins.string, (n - len(absent)) / m)), ruins, out)
    for k in range(m):
        left = 0
        for i in range(length[k]):
            routes[k, left] = routes[k, i]
            left += 0 if out[routes[k, i]] else 1
        length[k] = left
    bank = np.flatnonzero(out)
    np.random.shuffle(bank)
    return bank


@compiled
def _mark_strings(order, routes, length, longest, ruins, out):
    """Mark in out (n,) strings of up to `longest` stops around targets that come first in `order`, one of a route."""
    whole = np.ones(len(length), np.bool_)
    strings = int(np.random.uniform(1.0, 4.0 * ruins.removed / (1.0 + longest)))
    for w in order:
        if strings == 0:
            break
        for k in range(len(length)):
            i = 0
            while i < length[k] and routes[k, i] != w:
                i += 1
            if whole[k] and i < length[k]:
                size = int(np.random.uniform(1.0, min(longest, length[k]) + 1.0))
                first = np.random.randint(max(0, i - size + 1), min(i, length[k] - size) + 1)
                for j in range(first, first + size):
                    out[routes[k, j]] = True
                whole[k], strings = False, strings - 1


@compiled
def _absent(routes, length):
    """Return the targets on no route."""
    absent = np.ones(routes.shape[1], np.bool_)
    for k in range(len(length)):
        for i in range(length[k]):
            absent[routes[k, i]] = False
    return np.flatnonzero(absent)


@compiled
def ruin_and_recreate(
    by_layer, order, layer, demand, room, routes, length, penalty, ruins, iterations, warm, cool, seed
):  # fmt: skip
    """Return (routes (m, n), length (m,), best_length (m,), segments (m, n)): where annealing from the given routes
    ends, and the lengths and segments of the best routes on the way; `penalty` for each target left out.

    by_layer: see `grid.make_networks`; order: see `_closeness`; room: of each layer; layer: (m,) of each route, in
    order; demand: (n,).
    """
    np.random.seed(seed)
    m, n = routes.shape
    widest = 0
    for u in range(n):
        widest = max(widest, by_layer.start[u + 1] - by_layer.start[u])
    networks = [of_layer(by_layer, k) for k in layer]
    rows = n + 1, widest
    times = n + 1, 3
    values = [
        Values(np.zeros(rows), np.zeros(rows), np.zeros(n + 1), np.zeros(n + 1), np.zeros(times), np.zeros(times))
        for _ in range(m)
    ]
    arrive, leave = np.empty((1, widest)), np.empty((1, widest))
    routes, length, cost = routes.copy(), length.copy(), np.zeros(m)
    for k in range(m):
        cost[k] = evaluate(routes[k], length[k], networks[k], values[k], np.int64(0), np.int64(0))
    absent = _absent(routes, length)
    now = cost.sum() + penalty * len(absent)
    best, best_routes, best_length = now, routes.copy(), length.copy()
    segments = np.zeros((m, n), np.int64)
    for it in range(iterations):
        kept_routes, kept_length, kept_cost, kept_absent = routes.copy(), length.copy(), cost.copy(), absent
        bank = _remove(np.random.randint(n), order, routes, length, absent, ruins)
        for k in range(m):
            if length[k] != kept_length[k]:
                cost[k] = evaluate(routes[k], length[k], networks[k], values[k], np.int64(0), np.int64(0))
        absent = _insert_all(
            bank, routes, length, cost, networks, values, layer, demand, room, ruins.blink, arrive, leave
        )
        total = cost.sum() + penalty * len(absent)
        heat = ruins.heat * best * (warm + (cool - warm) * it / iterations) ** 2
        accepted = total < now - heat * math.log(np.random.random() + 1e-300)
        if accepted:
            now = total
            if total < best:
                best, best_routes, best_length = total, routes.copy(), length.copy()
            continue
        for k in range(m):
            changed = length[k] != kept_length[k]
            for i in range(length[k]):
                changed = changed or routes[k, i] != kept_routes[k, i]
            if changed:
                evaluate(kept_routes[k], kept_length[k], networks[k], values[k], np.int64(0), np.int64(0))
        routes, length, cost, absent = kept_routes, kept_length, kept_cost, kept_absent
    for k in range(m):
        evaluate(best_routes[k], best_length[k], networks[k], values[k], np.int64(0), np.int64(0))
        trace(best_routes[k], best_length[k], networks[k], values[k], segments[k])
    return routes, length, best_length, segments
