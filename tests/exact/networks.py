"""Small networks of pieces with random prices, and all real routes through them, for tests of the bounds."""

import dataclasses
import itertools
import math

import numpy as np

from mamttsp import Agents, Target, build_graph, generate
from mamttsp.exact.cuts import Cuts
from mamttsp.exact.evaluation import first_network
from mamttsp.exact.fleet import Fleet
from mamttsp.exact.pieces import even_cuts
from mamttsp.motion import earliest_meeting
from mamttsp.timing import best_times, earliest_times, leg_lengths


def small(seed, n=4, window=40):
    """Return the graph of a generated instance."""
    return build_graph(generate(n, window, seed=seed))


def unlike(seed, n=4, window=40, still=()):
    """Return the graph of a generated instance with two types of agents, their capacities too small for all demands;
    still: targets that do not move."""
    rng = np.random.default_rng(seed)
    demands = rng.uniform(1, 2, n)
    depots = rng.uniform(-40, 40, (3, 2))
    one = Agents(1, depots[0], rng.uniform(3, 5), capacity=demands.sum() * rng.uniform(0.6, 0.9))
    others = Agents(2, depots[1], rng.uniform(3, 6), end=depots[2], capacity=demands.sum() * rng.uniform(0.5, 0.9))
    instance = generate(n, window, seed=seed, agents=[one, others], demands=demands)
    targets = list(instance.targets)
    for u in still:
        places = np.repeat(targets[u].points[:1], len(targets[u].points), axis=0)
        targets[u] = Target(targets[u].times, places, targets[u].windows)
    return build_graph(dataclasses.replace(instance, targets=targets))


def alike(n_agents):
    """Return the Fleet of so many agents of one type."""
    return Fleet(np.array([n_agents]), 1)


def load(graph, route):
    """Return the demand of a route of segments."""
    return graph.demands[graph.tau[list(route)]].sum()


def network_of(graph, width):
    """Return the Network of pieces of at most `width` s."""
    return first_network(graph, even_cuts(graph, graph.V_seg, width), range(graph.n_targets))


def random_sets(rng, n):
    """Return random ng-sets, N (n, n) bool."""
    return rng.random((n, n)) < rng.choice([0.0, 0.3, 0.7, 1.0])


def random_cuts(rng, n, count=3):
    """Return Cuts on random rows, with random memories around them and random prices."""
    rows = np.zeros((count, n), bool)
    for row in rows:
        row[rng.choice(n, 3, replace=False)] = True
    return Cuts(rows, rows | (rng.random((count, n)) < 0.5), -20.0 * rng.random(count))


def flyable_routes(graph):
    """Return all routes of segments that an agent of their layer can fly, and carry."""
    routes, latest = [], [()]
    for _ in range(graph.n_targets):
        longer = [(*route, i) for route in latest for i in graph.V_seg if _can_follow(graph, route, i)]
        latest = [route for route in longer if earliest_times(graph, route) is not None]
        routes += latest
    return routes


def _can_follow(graph, route, i):
    own = not route or graph.layer[i] == graph.layer[route[0]]
    return own and graph.tau[i] not in graph.tau[list(route)] and load(graph, (*route, i)) <= graph.room[graph.layer[i]]


def random_times(graph, route, rng):
    """Return random visit times of a route that an agent can fly, or None if the last draw came too late."""
    layer = graph.layer[route[0]]
    place, now, times, speed = graph.p_lo[graph.starts[layer]], 0.0, [], graph.speeds[layer]
    for i in route:
        p, v, lo, hi = graph.p_lo[i], graph.v[i], graph.t_lo[i], graph.t_hi[i]
        early = earliest_meeting(*place, now, *p, lo, *v, lo, hi, speed)
        if math.isinf(early):
            return None
        now = early + (hi - early) * rng.choice([0.0, rng.random() ** 4, rng.random()])
        place = graph.position(i, now)
        times.append(now)
    home = now + np.linalg.norm(place - graph.p_lo[graph.ends[layer]]) / speed
    return np.array(times) if home <= graph.horizon else None


def timed_routes(graph, rng, draws=3):
    """Yield (route, times, legs) of all flyable routes, at random and at the best times; legs: (K + 1,) lengths."""
    for route in flyable_routes(graph):
        drawn = [random_times(graph, route, rng) for _ in range(draws)] + [best_times(graph, list(route))[1]]
        for times in drawn:
            if times is not None:
                yield route, times, leg_lengths(graph, route, times)


def pieces_at(pieces, segment, time):
    """Return the pieces of a segment that a time is in."""
    near = (pieces.a <= time + 1e-7) & (time <= pieces.b + 1e-7)
    return np.flatnonzero((pieces.segment == segment) & near)


def assert_flown(network, graph, routes):
    """The network holds pieces, arcs, starts and ends for the routes at their best times."""
    pieces = network.pieces
    arcs = set(zip(network.arcs.tail.tolist(), network.arcs.head.tolist()))
    for route in routes:
        times = best_times(graph, list(route))[1]
        ways = [(q,) for q in pieces_at(pieces, route[0], times[0]) if network.starts[q]]
        for i, time in list(zip(route, times))[1:]:
            ways = [(*way, r) for way in ways for r in pieces_at(pieces, i, time) if (way[-1], r) in arcs]
        assert any(network.ends[way[-1]] for way in ways), route


def pays(route, cuts):
    """Return what a sequence of targets pays for cuts, >= 0: half of the visits to a row, rounded down, in each stretch
    within the cut's memory."""
    total = 0.0
    for row, memory, sigma in zip(cuts.rows, cuts.memory, cuts.sigma):
        for inside, stretch in itertools.groupby(route, key=lambda u: memory[u]):
            total -= sigma * (sum(row[u] for u in stretch) // 2 if inside else 0)
    return total


def in_full(cuts):
    """Return the cuts with all targets in their memories."""
    return Cuts(cuts.rows, np.ones_like(cuts.memory), cuts.sigma)


def best_solution(graph, fleet):
    """Return (length, routes) of a best solution by enumeration, an infinite length without one."""
    shortest = [{} for _ in fleet.counts]
    for route in flyable_routes(graph):
        served, found = frozenset(graph.tau[list(route)].tolist()), best_times(graph, list(route))[0]
        of_layer = shortest[graph.layer[route[0]]]
        if found < of_layer.get(served, (math.inf,))[0]:
            of_layer[served] = found, route
    best = {frozenset(): (0.0, ())}
    for k in np.repeat(np.arange(len(fleet.counts)), fleet.counts):
        longer = dict(best)
        for (done, (length, routes)), (served, (own, route)) in itertools.product(best.items(), shortest[k].items()):
            if not done & served and length + own < longer.get(done | served, (math.inf,))[0]:
                longer[done | served] = length + own, (*routes, route)
        best = longer
    return best.get(frozenset(range(graph.n_targets)), (math.inf, ()))
