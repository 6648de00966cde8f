"""Routes on a time grid against plain Python: values are shortest paths through layers of points."""

import itertools
import math

import numpy as np
import pytest

from mamttsp.exact.grid import Values, evaluate, grid_points, make_networks, min_plus, trace
from mamttsp.exact.ruin_and_recreate import _alike, _no_plan, _place, _take
from mamttsp.motion import TIME_SLACK
from mamttsp.timing import earliest_times
from tests.exact.networks import unlike

SEEDS = range(6)


def _grid(seed, slack=1.0, charge=0.5):
    """Return (graph, Network, Points) of an instance with two types of agents, where one target stands still."""
    graph = unlike(seed, n=5, window=60, still=[seed % 5])
    points = grid_points(graph, range(5), 6)
    return graph, make_networks(graph, range(5), points, slack, [charge])[0], points


def _flight(graph, network, k, here, there):
    """Return what it costs an agent of layer k to fly from one point to another, each (place, first, last time)."""
    (place, time, _), (other, _, later) = here, there
    speed, distance = graph.speeds[k], math.dist(place, other)
    short = max(distance - speed * (later - time), 0.0)
    return distance + network.charge * short if short <= speed * network.late else math.inf


def _stops(graph, k, points):
    """Return (place, first time, last time) of all Points, of the depot and of the end of a layer."""
    within = [(graph.position(i, t), t, later) for i, t, later in zip(points.node, points.opens, points.closes)]
    depot, end = graph.p_lo[graph.starts[k]], graph.p_lo[graph.ends[k]]
    return within, (depot, 0.0, 0.0), (end, graph.horizon, graph.horizon)


def _flights(network, k, ways, here, there):
    """Return the flights from each point of a target to those of another, by `min_plus` from that point alone."""
    size, wide = (int(np.diff(network.start)[u]) for u in (here, there))
    alone, out = np.where(np.eye(size) > 0, 0.0, np.inf), np.full((size, wide), -1e6)
    how = network.start, ways[k], network.motion.speed[k], network.late, network.charge
    least = [min_plus(alone, g, here, there, *how, out, g) for g in range(size)]
    assert least == out.min(axis=1).tolist()
    return out


def _room(m, n, start):
    """Return (values, arrive, leave), wrong but for the 0 of the depot and the end, so that whoever reads others is
    found out."""
    widest = int(np.diff(start).max())
    rows, least = np.full((2, m, n + 1, widest), -1e6), np.full((2, m, n + 1), -1e6)
    rows[:, :, 0, 0], least[:, :, 0] = 0.0, 0.0
    values = Values(*rows, *least, *np.full((2, m, n + 1, 3), -1e6), np.zeros(1, np.int64))
    return values, *np.full((2, 1, widest), -1e6)


def _some_routes(rng, n):
    """Return (row, length) of routes; behind a route its row goes on with other targets."""
    return [(rng.permutation(n), int(rng.integers(1, n))) for _ in range(15)]


def _flyable(graph, layer, route):
    """Tell whether the targets can be served in this order, along some of their segments."""
    clusters = [[i for i in graph.C(u) if graph.layer[i] == layer] for u in route]
    return any(earliest_times(graph, segments) is not None for segments in itertools.product(*clusters))


def _shortest(graph, layer, route, network, points):
    """Return the least length of a path through points of a route's targets, one after the other, infinite if it cannot
    be flown at any times."""
    if not _flyable(graph, layer, route):
        return math.inf
    within, depot, end = _stops(graph, layer, points)
    lengths = [(0.0, depot)]
    for u in route:
        own = [g for g, i in enumerate(points.node) if graph.tau[i] == u]
        lengths = [(_least(graph, network, layer, lengths, within[g]), within[g]) for g in own]
    return _least(graph, network, layer, lengths, end)


def _least(graph, network, layer, lengths, there):
    return min(length + _flight(graph, network, layer, here, there) for length, here in lengths)


@pytest.mark.parametrize("seed", SEEDS)
def test_points_lie_on_all_segments_of_the_first_layer_ends_included(seed):
    graph, _, (node, opens, closes, start, step) = _grid(seed)
    for u in range(5):
        own = range(start[u], start[u + 1])
        assert {int(node[g]) for g in own} == {int(i) for i in graph.C(u) if graph.layer[i] == 0}
        for i in {node[g] for g in own}:
            times = [(opens[g], closes[g]) for g in own if node[g] == i]
            assert times[0][0] == graph.t_lo[i] and times[-1][1] == graph.t_hi[i]
            if not graph.v[i].any():
                assert len(times) == 1
                continue
            assert all(sooner == later for sooner, later in times)
            assert all(0 < t - s <= step * (1 + 1e-9) for (s, _), (t, _) in itertools.pairwise(times))


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("slack, charge", [(0.0, 0.0), (0.5, 0.0), (1.0, 0.7)])
def test_flights_are_distances_and_what_is_charged_where_time_is_short(seed, slack, charge):
    graph, network, points = _grid(seed, slack, charge)
    assert network.late == slack * points.step + TIME_SLACK * graph.horizon and network.charge == charge
    assert network.start.tolist() == [*points.start, len(points.node) + 1]
    for k in range(graph.n_layers):
        within, depot, end = _stops(graph, k, points)
        tails, heads = [*within, depot], [*within, end]
        for u, w in itertools.permutations(range(6), 2):  # with the depot and the end
            here, there = (range(network.start[v], network.start[v + 1]) for v in (u, w))
            expected = [[_flight(graph, network, k, tails[g], heads[h]) for h in there] for g in here]
            assert _flights(network, k, network.ahead, u, w) == pytest.approx(np.array(expected), abs=1e-9)
            assert _flights(network, k, network.back, w, u) == pytest.approx(np.array(expected).T, abs=1e-9)
            assert network.near[k, u, w] == pytest.approx(np.min(expected), abs=1e-9)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_route_costs_its_shortest_path_and_its_segments_can_be_flown(seed):
    rng = np.random.default_rng(seed)
    graph, network, points = _grid(seed)
    values, *_ = _room(1, 5, points.start)
    segments, found = np.zeros(5, np.int64), 0
    of_first_layer = [i for u in range(5) for i in graph.C(u) if graph.layer[i] == 0]
    for k, (row, length) in itertools.product(range(graph.n_layers), _some_routes(rng, 5)):
        route = row[:length]
        expected = _shortest(graph, k, route, network, points)
        assert evaluate(0, k, row, length, network, values, 0, 0) == pytest.approx(expected)
        if math.isfinite(expected):
            trace(0, k, row, length, network, values, segments)
            way = [of_first_layer[s] + int(graph.starts[k]) for s in segments[:length]]
            assert graph.tau[way].tolist() == route.tolist() and earliest_times(graph, way) is not None
            found += 1
    assert found > 3


@pytest.mark.parametrize("seed", SEEDS)
def test_what_holds_already_is_not_filled_in_anew(seed):
    rng = np.random.default_rng(seed)
    graph, network, points = _grid(seed)
    for k, (row, length) in itertools.product(range(graph.n_layers), _some_routes(rng, 5)):
        values, i = _room(1, 5, points.start)[0], int(rng.integers(length))
        without = np.append(np.delete(row, i), row[i])
        if math.isinf(evaluate(0, k, without, length - 1, network, values, 0, 0)):
            continue
        ahead, behind = _alike(row, length, without, length - 1)
        assert (ahead, behind) == (i, length - 1 - i)
        expected = _shortest(graph, k, row[:length], network, points)
        assert evaluate(0, k, row, length, network, values, ahead, behind) == pytest.approx(expected)


def test_routes_alike_at_both_ends_share_no_stop_twice():
    assert _alike(np.array([1, 2, 3, 9]), 3, np.array([1, 2, 3, 8]), 3) == (3, 0)
    assert _alike(np.array([1, 1, 1]), 2, np.array([1, 1, 1]), 3) == (2, 0)
    assert _alike(np.array([1, 4, 3]), 3, np.array([1, 2, 3]), 3) == (1, 1)
    assert _alike(np.array([5]), 0, np.array([5]), -1) == (0, 0)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_plan_is_taken_with_all_that_later_insertions_read(seed):
    rng = np.random.default_rng(seed)
    graph, network, points = _grid(seed)
    plan, kept = (_no_plan(2, 5, int(np.diff(points.start).max())) for _ in range(2))
    for row, length in _some_routes(rng, 5):
        for k in range(2):
            plan.routes[k], plan.length[k] = row, (length, 0)[k]
            plan.cost[k] = evaluate(k, k, row, plan.length[k], network, plan.values, 0, 0)
        _take(plan, kept)
        assert kept.length.tolist() == plan.length.tolist() and kept.cost.tolist() == plan.cost.tolist()
        assert kept.routes[0, :length].tolist() == row[:length].tolist()
        for of, other in zip(plan.values[:-1], kept.values[:-1]):
            assert of[0, : length + 1].tolist() == other[0, : length + 1].tolist()
            assert of[1, 0].tolist() == other[1, 0].tolist()


@pytest.mark.parametrize("seed", SEEDS)
def test_a_target_is_placed_where_that_makes_its_route_least_longer(seed):
    rng = np.random.default_rng(seed)
    graph, network, points = _grid(seed)
    layer, room, placed = np.arange(2), graph.room, 0
    for _ in range(10):
        dealt, cut, w = rng.permutation(5), int(rng.integers(5)), 0
        rows = [[u for u in dealt[:cut] if u != w], [u for u in dealt[cut:] if u != w]]
        routes, length = np.full((2, 5), w), np.array([len(row) for row in rows])
        values, arrive, leave = _room(2, 5, points.start)
        for k, row in enumerate(rows):
            routes[k, : len(row)] = row
        cost = np.array([evaluate(k, k, routes[k], length[k], network, values, 0, 0) for k in layer])
        if not np.isfinite(cost).all():
            continue
        longer = {
            (k, i): _shortest(graph, k, [*row[:i], w, *row[i:]], network, points) - cost[k]
            for k, row in enumerate(rows)
            for i in range(len(row) + 1)
            if graph.demands[[w, *row]].sum() <= room[k]
        }
        found = _place(w, routes, length, cost, network, values, layer, graph.demands, room, 0.0, arrive, leave)
        least = min(longer.values(), default=math.inf)
        assert (found[0] < 0) == math.isinf(least)
        if math.isfinite(least):
            assert longer[found] == pytest.approx(least, abs=1e-9)
            placed += 1
    assert placed
