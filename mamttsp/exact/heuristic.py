"""First tours: ruin and recreate on a time grid (after Christiaens and Vanden Berghe 2020, without their string
removal).

Visits are restricted to grid times of their segments, so that a route is a shortest path through layers of grid points,
and insertions are priced from the values so far and the values to go. A flight on the grid may come half a step
late, for the grid would else be too strict; what is kept can be flown, by the exact earliest times of its segments.
"""

import math

import numpy as np
from numba import njit

from ..motion import TIME_SLACK, earliest_meeting

_GRID = 24
_BLINK = 0.02


class Annealing:
    """Ruin and recreate by simulated annealing, from nothing or on from where it stands. Deterministic for a seed."""

    def __init__(self, graph, targets, n_agents, seed=0):
        self.m, self.n, self.seed, self.penalty = n_agents, len(targets), seed, 4.0 * graph.size
        self.node, time, self.start, step = _grid(graph, targets)
        p = graph.p_lo[self.node] + (time - graph.t_lo[self.node])[:, None] * graph.v[self.node]
        owner = np.repeat(np.arange(self.n), np.diff(self.start))
        self.network = _distances(p, time, owner, graph.p_lo[0], graph.max_speed, graph.horizon, 0.5 * step)
        segment = np.c_[graph.p_lo, graph.v, graph.t_lo, graph.t_hi][self.node]
        self.motion = segment, graph.p_lo[0].copy(), graph.max_speed, graph.horizon
        self.routes, self.length = np.zeros((n_agents, self.n), np.int64), np.zeros(n_agents, np.int64)

    def run(self, iterations, warm, cool):
        """Anneal on, from heat `warm` to `cool` (1 to 0); return routes (tuples of segments) that serve all targets
        and can be flown, or None while there are none."""
        self.seed += 1
        self.routes, self.length, length, points = ruin_and_recreate(
            *self.network, self.start, *self.motion, self.routes, self.length, self.penalty,
            iterations, warm, cool, self.seed,
        )  # fmt: skip
        if length.sum() < self.n:
            return None
        return [tuple(int(self.node[g]) for g in points[k, : length[k]]) for k in range(self.m) if length[k]]


def _grid(graph, targets):
    """Return (node, time, start, step): about _GRID points for each target, both ends of each of its segments among
    them.

    start: (n + 1,) where the points of each target begin; step: the longest time between two points.
    """
    nodes, times, start, longest = [], [], [0], 0.0
    for u in targets:
        cluster = graph.C(u)
        step = (graph.t_hi[cluster] - graph.t_lo[cluster]).sum() / _GRID
        for i in cluster:
            duration = graph.t_hi[i] - graph.t_lo[i]
            grid = np.linspace(graph.t_lo[i], graph.t_hi[i], 1 + math.ceil(duration / step) if duration > 0 else 1)
            nodes.append(np.full(len(grid), i))
            times.append(grid)
        start.append(start[-1] + sum(len(grid) for grid in times[-len(cluster) :]))
        longest = max(longest, step)
    return np.concatenate(nodes), np.concatenate(times), np.array(start), longest


@njit(cache=True)
def _distances(p, time, target, depot, speed, horizon, slack):
    """Return (between (P, P), first (P,), last (P,)): distances, infinite where a flight would be more than `slack`
    s late."""
    P = len(time)
    between, first, last = np.full((P, P), np.inf), np.full(P, np.inf), np.full(P, np.inf)
    slack += TIME_SLACK * horizon
    for g in range(P):
        d = math.hypot(p[g, 0] - depot[0], p[g, 1] - depot[1])
        if d <= speed * (time[g] + slack):
            first[g] = d
        if d <= speed * (horizon - time[g] + slack):
            last[g] = d
        for h in range(P):
            d = math.hypot(p[h, 0] - p[g, 0], p[h, 1] - p[g, 1])
            if target[g] != target[h] and d <= speed * (time[h] - time[g] + slack):
                between[g, h] = d
    return between, first, last


@njit(cache=True)
def _relax_step(values, u, w, between, start, out):
    """out[h] = least values[g] + distance from point g of target u to point h of target w."""
    for h in range(start[w + 1] - start[w]):
        best = np.inf
        for g in range(start[u + 1] - start[u]):
            best = min(best, values[g] + between[start[u] + g, start[w] + h])
        out[h] = best


@njit(cache=True)
def _relax_back(values, w, u, between, start, out):
    """out[g] = least distance from point g of target w to point h of target u + values[h]."""
    for g in range(start[w + 1] - start[w]):
        best = np.inf
        for h in range(start[u + 1] - start[u]):
            best = min(best, between[start[w] + g, start[u] + h] + values[h])
        out[g] = best


@njit(cache=True)
def _evaluate(route, length, between, first, last, start, so_far, to_go):
    """Fill the values so far and to go at each stop of a route; return its cost."""
    if length == 0:
        return 0.0
    for i in range(length):
        w = route[i]
        if i == 0:
            so_far[0, : start[w + 1] - start[w]] = first[start[w] : start[w + 1]]
        else:
            _relax_step(so_far[i - 1], route[i - 1], w, between, start, so_far[i])
    for i in range(length - 1, -1, -1):
        w = route[i]
        if i == length - 1:
            to_go[i, : start[w + 1] - start[w]] = last[start[w] : start[w + 1]]
        else:
            _relax_back(to_go[i + 1], w, route[i + 1], between, start, to_go[i])
    w = route[0]
    size = start[w + 1] - start[w]
    return np.min(so_far[0, :size] + to_go[0, :size])


@njit(cache=True)
def _insertion(w, route, length, i, between, first, last, start, so_far, to_go, arrive, leave):
    """Return the route's cost with w inserted before its stop i."""
    size = start[w + 1] - start[w]
    if i == 0:
        arrive[:size] = first[start[w] : start[w + 1]]
    else:
        _relax_step(so_far[i - 1], route[i - 1], w, between, start, arrive)
    if i == length:
        leave[:size] = last[start[w] : start[w + 1]]
    else:
        _relax_back(to_go[i], w, route[i], between, start, leave)
    return np.min(arrive[:size] + leave[:size])


@njit(cache=True)
def _insert_all(bank, routes, length, cost, between, first, last, start, so_far, to_go, arrive, leave):
    """Insert each target of the bank at its cheapest place; return those for which there is none."""
    left = 0
    for b in range(len(bank)):
        w, best, best_k, best_i = bank[b], np.inf, -1, -1
        seen_empty = False
        for k in range(len(length)):
            if length[k] == 0:
                if seen_empty:
                    continue
                seen_empty = True
            for i in range(length[k] + 1):
                if np.random.random() < _BLINK:
                    continue
                total = _insertion(
                    w, routes[k], length[k], i, between, first, last, start, so_far[k], to_go[k], arrive, leave
                )
                if total - cost[k] < best:
                    best, best_k, best_i = total - cost[k], k, i
        if best_k < 0:
            bank[left] = w
            left += 1
            continue
        for j in range(length[best_k], best_i, -1):
            routes[best_k, j] = routes[best_k, j - 1]
        routes[best_k, best_i] = w
        length[best_k] += 1
        cost[best_k] = _evaluate(
            routes[best_k], length[best_k], between, first, last, start, so_far[best_k], to_go[best_k]
        )
    return bank[:left]


@njit(cache=True)
def _closeness(between, start, n):
    """Return (n, n): the other targets of each, closest first."""
    near = np.full((n, n), np.inf)
    for u in range(n):
        for w in range(n):
            if u != w:
                here = between[start[u] : start[u + 1], start[w] : start[w + 1]].min()
                near[u, w] = min(near[u, w], here)
                near[w, u] = min(near[w, u], here)
    order = np.empty((n, n), np.int64)
    for u in range(n):
        order[u] = np.argsort(near[u])
    return order


@njit(cache=True)
def _remove(seed, how_many, order, routes, length, absent):
    """Take the seed target and close ones out of their routes; return them, together with `absent`, shuffled."""
    n = len(order)
    out = np.zeros(n, np.bool_)
    out[seed] = True
    taken = 1
    for w in order[seed]:
        if taken >= how_many:
            break
        if w != seed and np.random.random() < 0.7:
            out[w] = True
            taken += 1
    for k in range(len(length)):
        kept = 0
        for i in range(length[k]):
            if not out[routes[k, i]]:
                routes[k, kept] = routes[k, i]
                kept += 1
        length[k] = kept
    out[absent] = True
    bank = np.flatnonzero(out)
    np.random.shuffle(bank)
    return bank


@njit(cache=True)
def _flyable(points, length, segment, depot, speed, horizon):
    """Tell whether the segments of the points can be met in this order, and the depot by the horizon."""
    px, py, t = depot[0], depot[1], 0.0
    for i in range(length):
        x, y, vx, vy, start, end = segment[points[i]]
        t = earliest_meeting(px, py, t, x, y, start, vx, vy, start, end, speed)
        if t == np.inf:
            return False
        px, py = x + (t - start) * vx, y + (t - start) * vy
    return earliest_meeting(px, py, t, depot[0], depot[1], 0.0, 0.0, 0.0, 0.0, horizon, speed) < np.inf


@njit(cache=True)
def ruin_and_recreate(
    between, first, last, start, segment, depot, speed, horizon, routes, length, penalty, iterations, warm, cool, seed
):
    """Return (routes (m, n), length (m,), best_length (m,), points (m, n)): where annealing from the given routes ends,
    and the lengths and grid points of the best routes on the way; `penalty` for each target left out. segment: (P, 6)
    motion of each point's segment."""
    np.random.seed(seed)
    m, n = routes.shape
    widest = np.max(start[1:] - start[:-1])
    routes, length, cost = routes.copy(), length.copy(), np.zeros(m)
    so_far, to_go = np.empty((m, n, widest)), np.empty((m, n, widest))
    arrive, leave = np.empty(widest), np.empty(widest)
    order = _closeness(between, start, n)
    absent_here = np.ones(n, np.bool_)
    for k in range(m):
        absent_here[routes[k, : length[k]]] = False
        cost[k] = _evaluate(routes[k], length[k], between, first, last, start, so_far[k], to_go[k])
    absent = np.flatnonzero(absent_here)
    now = cost.sum() + penalty * len(absent)
    best, best_routes, best_length = now, routes.copy(), length.copy()
    points = np.zeros((m, n), np.int64)
    for it in range(iterations):
        kept_routes, kept_length, kept_cost, kept_absent = routes.copy(), length.copy(), cost.copy(), absent
        bank = _remove(np.random.randint(n), np.random.randint(1, min(n, 8) + 1), order, routes, length, absent)
        for k in range(m):
            if length[k] != kept_length[k]:
                cost[k] = _evaluate(routes[k], length[k], between, first, last, start, so_far[k], to_go[k])
        absent = _insert_all(
            bank, routes, length, cost, between, first, last, start, so_far, to_go, arrive, leave
        ).copy()
        total = cost.sum() + penalty * len(absent)
        heat = 0.02 * best * (warm + (cool - warm) * it / iterations) ** 2
        changed = np.zeros(m, np.bool_)
        for k in range(m):
            changed[k] = length[k] != kept_length[k] or np.any(routes[k, : length[k]] != kept_routes[k, : length[k]])
        accepted = total < now - heat * math.log(np.random.random() + 1e-300)
        for k in range(m):
            if accepted and changed[k]:
                _trace(routes[k], length[k], between, first, start, to_go[k], points[k])
                accepted = _flyable(points[k], length[k], segment, depot, speed, horizon)
        if accepted:
            now = total
            if total < best:
                best, best_routes, best_length = total, routes.copy(), length.copy()
        else:
            routes, length, cost, absent = kept_routes, kept_length, kept_cost, kept_absent
            for k in range(m):
                if changed[k]:
                    _evaluate(routes[k], length[k], between, first, last, start, so_far[k], to_go[k])
    for k in range(m):
        _evaluate(best_routes[k], best_length[k], between, first, last, start, so_far[k], to_go[k])
        _trace(best_routes[k], best_length[k], between, first, start, to_go[k], points[k])
    return routes, length, best_length, points


@njit(cache=True)
def _trace(route, length, between, first, start, to_go, points):
    """Fill the grid points of a cheapest flight along a route that is evaluated."""
    for i in range(length):
        w = route[i]
        best = np.inf
        for g in range(start[w], start[w + 1]):
            here = first[g] if i == 0 else between[points[i - 1], g]
            if here + to_go[i, g - start[w]] < best:
                best, points[i] = here + to_go[i, g - start[w]], g
