"""First tours: ruin and recreate (after Christiaens and Vanden Berghe 2020).

Costs are those of visits on a time grid (see `grid`); what can be flown is told by exact times (see `reach`).
"""

import math
from collections import namedtuple

import numpy as np

from ..compiled import compiled
from .grid import Values, evaluate, grid_points, least_sum, make_networks, min_plus, stop, trace
from .reach import fits, segments_of

#: Routes (m, n), their lengths (m,) and costs (m,), and the Values along them
Plan = namedtuple("Plan", "routes length cost values")
#: What a ruin takes out, see `parameters.Parameters`: `removed` targets on average, of one route no more than `string`;
#: `radial`: how often they are the closest ones; `shuffled`: how often they come back in random order, and `ranks`
#: (R, n) by which they do else; blink: how often a place is overlooked; heat: of annealing at first
Ruins = namedtuple("Ruins", "removed string radial shuffled ranks blink heat")


class Annealing:
    """Ruin and recreate by simulated annealing, from nothing or on from where it stands. Deterministic for a seed.

    filled: rows of values on the time grid so far, nearly all of its work.
    """

    def __init__(self, graph, targets, fleet, parameters, seed=0):
        p = parameters
        self.m, self.n, self.seed, self.penalty = fleet.n_agents, len(targets), seed, p.left_out * (graph.size or 1.0)
        self.ruins = Ruins(
            p.removed, p.string, p.radial, p.shuffled, _ranks(graph, targets), p.blink, p.heat
        )  # fmt: skip
        points = grid_points(graph, targets, p.grid)
        self.networks = make_networks(graph, targets, points, p.grid_slack, p.grid_charges)
        self.order = _closeness(self.networks[0].near[:, :-1, :-1])
        self.nodes = np.concatenate([segments_of(graph, u) for u in targets])
        self.layer = np.repeat(np.arange(len(fleet.counts)), fleet.counts)
        self.loads = self.layer, graph.demands[list(targets)], graph.room
        self.first_node = graph.starts[self.layer]
        self.filled = 0
        self.begin()

    def begin(self):
        """Begin from nothing."""
        self.routes, self.length = np.zeros((self.m, self.n), np.int64), np.zeros(self.m, np.int64)

    def run(self, iterations, warm, cool):
        """Anneal on, from heat `warm` to `cool` (1 to 0); return routes (tuples of segments) that serve all targets
        and can be flown, or None while there are none."""
        self.seed += 1
        self.routes, self.length, length, segments, filled = ruin_and_recreate(
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
        self.filled += filled
        if length.sum() < self.n:
            return None
        nodes = self.nodes[segments] + self.first_node[:, None]
        return [tuple(nodes[k, : length[k]].tolist()) for k in range(self.m) if length[k]]


@compiled
def _place(w, routes, length, cost, network, values, layer, demand, room, blink, arrive, leave):
    """Return (k, i): the cheapest place to insert w, before stop i of route k; k = -1 if there is none.

    Arrays are unpacked first: numba counts references at each attribute otherwise.
    """
    places, bound = _places(w, routes, length, cost, network.near, values, layer, demand, room, blink)
    ahead, back, start, near, tardy, charge, _, (first, segments, _, speeds, slack) = network
    so_far, to_go, _, least_to_go, early, late, filled = values
    best, best_k, best_i = np.inf, -1, -1
    while len(bound):
        place = np.argmin(bound)
        if bound[place] >= best:
            break
        bound[place], k, i = np.inf, places[place, 0], places[place, 1]
        of, rest, cutoff, speed = layer[k], length[k] - i, best + cost[k], speeds[layer[k]]
        before, behind = stop(routes[k], length[k], i - 1), stop(routes[k], length[k], i)
        if not fits(w, behind, early[k, i], slack - late[k, rest, 2], first, segments[of], speed):
            continue
        filled[0] += 1
        arrived = min_plus(so_far[k], i, before, w, start, ahead[of], speed, tardy, charge, arrive, 0)
        if arrived + near[of, w, behind] + least_to_go[k, rest] >= cutoff:
            continue
        filled[0] += 1
        min_plus(to_go[k], rest, behind, w, start, back[of], speed, tardy, charge, leave, 0)
        total = least_sum(arrive, 0, leave, 0, start[w + 1] - start[w])
        if total < cutoff:
            best, best_k, best_i = total - cost[k], k, i
    return best_k, best_i


@compiled
def _places(w, routes, length, cost, near, values, layer, demand, room, blink):
    """Return (places (P, 2), bound (P,)): routes and stops before which w might be inserted, and at least what that
    costs, from shortest flights."""
    places, bound = np.empty((len(length) + routes.shape[1], 2), np.int64), np.empty(len(length) + routes.shape[1])
    least_so_far, least_to_go, n = values.least_so_far, values.least_to_go, routes.shape[1]
    size, seen_empty = 0, -1
    for k in range(len(length)):
        of = layer[k]
        if length[k] == 0:
            if seen_empty == of:  # one like it
                continue
            seen_empty = of
        if demand[w] + _load(routes[k], length[k], demand) > room[of]:
            continue
        before = n
        for i in range(length[k] + 1):
            behind = routes[k, i] if i < length[k] else n
            least = least_so_far[k, i] + near[of, before, w] + near[of, w, behind] + least_to_go[k, length[k] - i]
            if least < np.inf and np.random.random() >= blink:
                places[size, 0], places[size, 1], bound[size] = k, i, least - cost[k]
                size += 1
            before = behind
    return places[:size], bound[:size]


@compiled
def _load(route, length, demand):
    total = 0.0
    for i in range(length):
        total += demand[route[i]]
    return total


@compiled
def _insert_all(bank, routes, length, cost, network, values, layer, demand, room, blink, arrive, leave):
    """Insert each target of the bank at its cheapest place; return those for which there is none."""
    left = 0
    for w in bank:
        k, i = _place(w, routes, length, cost, network, values, layer, demand, room, blink, arrive, leave)
        if k < 0:
            bank[left] = w
            left += 1
            continue
        for j in range(length[k], i, -1):
            routes[k, j] = routes[k, j - 1]
        routes[k, i] = w
        length[k] += 1
        cost[k] = evaluate(k, layer[k], routes[k], length[k], network, values, i, length[k] - 1 - i)
    return bank[:left].copy()


def _ranks(graph, targets):
    """Return (5, n) ranks: least of targets far from the depot, of large demand, short windows, early ones, late ones.

    Far first and large first are orders of Christiaens and Vanden Berghe as well.
    """
    ranks = []
    for u in targets:
        own = segments_of(graph, u)
        far = np.linalg.norm(graph.p_lo[own] - graph.p_lo[graph.starts[0]], axis=1).min()
        opens, closes = graph.t_lo[own], graph.t_hi[own]
        ranks.append((-far, -graph.demands[u], (closes - opens).sum(), opens.min(), -closes.max()))
    return np.array(ranks).T.copy()


def _closeness(near):
    """Return (n, n): each target and behind it the others, closest first; near: (K, n, n) shortest flights' lengths."""
    close = np.minimum(near, near.transpose(0, 2, 1)).min(axis=0)
    np.fill_diagonal(close, -1.0)
    return np.argsort(close, axis=1, kind="stable")


@compiled
def _remove(seed, order, routes, length, absent, ruins):
    """Take strings of neighbouring stops out of routes that come close to the seed target, or the targets closest to
    it; return them, together with `absent`, in the order in which they are to come back."""
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
    if np.random.random() >= ruins.shuffled:
        bank = bank[np.argsort(ruins.ranks[np.random.randint(len(ruins.ranks))][bank])]
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
def _no_plan(m, n, widest):
    """Return a Plan of routes that are like no others."""
    rows, least, times = (m, n + 1, widest), (m, n + 1), (m, n + 1, 3)
    values = Values(
        np.zeros(rows), np.zeros(rows), np.zeros(least), np.zeros(least), np.zeros(times), np.zeros(times),
        np.zeros(1, np.int64),
    )  # fmt: skip
    return Plan(np.zeros((m, n), np.int64), np.full(m, -1), np.zeros(m), values)


@compiled
def _alike(route, length, other, other_length):
    """Return (ahead, behind): how many first and last stops a route has in common with another one."""
    ahead, behind, most = 0, 0, min(length, other_length)
    while ahead < most and route[ahead] == other[ahead]:
        ahead += 1
    while behind < most - ahead and route[length - 1 - behind] == other[other_length - 1 - behind]:
        behind += 1
    return ahead, behind


@compiled
def _take(plan, other):
    """Make the routes of the other Plan those of `plan`, with their values."""
    m = len(plan.length)
    so_far, to_go, least_so_far, least_to_go, early, late, _ = plan.values
    for k in range(m):
        length = plan.length[k]
        ahead, _ = _alike(plan.routes[k], length, other.routes[k], other.length[k])
        if ahead == length == other.length[k]:
            continue
        other.length[k], other.cost[k] = length, plan.cost[k]
        for i in range(length):
            other.routes[k, i] = plan.routes[k, i]
        for i in range(length + 1):
            other.values.least_so_far[k, i], other.values.least_to_go[k, i] = least_so_far[k, i], least_to_go[k, i]
            for g in range(so_far.shape[2]):
                other.values.so_far[k, i, g], other.values.to_go[k, i, g] = so_far[k, i, g], to_go[k, i, g]
            for x in range(3):
                other.values.early[k, i, x], other.values.late[k, i, x] = early[k, i, x], late[k, i, x]


@compiled
def ruin_and_recreate(
    network, order, layer, demand, room, routes, length, penalty, ruins, iterations, warm, cool, seed
):  # fmt: skip
    """Return (routes (m, n), length (m,), best_length (m,), segments (m, n), filled): where annealing from the given
    routes ends, the lengths and segments of the best routes on the way, and how many rows of values it filled;
    `penalty` for each target left out.

    network: see `grid`; order: see `_closeness`; room: of each layer; layer: (m,) of each route, in
    order; demand: (n,).
    """
    np.random.seed(seed)
    m, n = routes.shape
    widest = 0
    for u in range(n):
        widest = max(widest, network.start[u + 1] - network.start[u])
    arrive, leave = np.empty((1, widest)), np.empty((1, widest))
    plan, kept = _no_plan(m, n, widest), _no_plan(m, n, widest)
    plan.routes[:], plan.length[:] = routes, length
    routes, length, cost, values = plan
    for k in range(m):
        cost[k] = evaluate(k, layer[k], routes[k], length[k], network, values, np.int64(0), np.int64(0))
    absent = _absent(routes, length)
    now = cost.sum() + penalty * len(absent)
    best, best_routes, best_length = now, routes.copy(), length.copy()
    segments = np.zeros((m, n), np.int64)
    _take(plan, kept)
    for it in range(iterations):
        bank = _remove(np.random.randint(n), order, routes, length, absent, ruins)
        for k in range(m):
            if length[k] != kept.length[k]:
                ahead, behind = _alike(routes[k], length[k], kept.routes[k], kept.length[k])
                cost[k] = evaluate(k, layer[k], routes[k], length[k], network, values, ahead, behind)
        left = _insert_all(bank, routes, length, cost, network, values, layer, demand, room, ruins.blink, arrive, leave)
        total = cost.sum() + penalty * len(left)
        heat = ruins.heat * best * (warm + (cool - warm) * it / iterations) ** 2
        if total < now - heat * math.log(np.random.random() + 1e-300):
            now, absent = total, left
            _take(plan, kept)
            if total < best:
                best, best_routes, best_length = total, routes.copy(), length.copy()
        else:
            _take(kept, plan)
    for k in range(m):
        evaluate(k, layer[k], best_routes[k], best_length[k], network, values, np.int64(0), np.int64(0))
        trace(k, layer[k], best_routes[k], best_length[k], network, values, segments[k])
    return routes, length, best_length, segments, values.filled[0]
