"""Routes on a time grid against plain Python: values are shortest paths through layers of points."""

import itertools
import math

import numpy as np
import pytest
from numba.typed import List

from mamttsp.exact.grid import Values, evaluate, grid_points, make_networks, of_layer, trace
from mamttsp.exact.ruin_and_recreate import _place
from mamttsp.motion import TIME_SLACK
from mamttsp.timing import earliest_times
from tests.exact.networks import unlike

SEEDS = range(6)


def _grid(seed, slack=1.0, charge=0.5):
    """Return (graph, Networks, node, time, start, step) of an instance with two types of agents."""
    graph = unlike(seed, n=5, window=60)
    points = grid_points(graph, range(5), 6)
    return graph, make_networks(graph, range(5), points, slack, [charge])[0], *points


def _room(n, start):
    """Return (values, arrive, leave), wrong but for the 0 of the depot and the end, so that whoever reads others is
    found out."""
    widest = int(np.diff(start).max())
    rows, least = np.full((2, n + 1, widest), -1e6), np.full((2, n + 1), -1e6)
    rows[:, 0, 0], least[:, 0] = 0.0, 0.0
    return Values(*rows, *least, *np.full((2, n + 1, 3), -1e6)), *np.full((2, 1, widest), -1e6)


def _some_routes(rng, n):
    """Return (row, length) of routes; behind a route its row goes on with other targets."""
    return [(rng.permutation(n), int(rng.integers(1, n))) for _ in range(15)]


def _flyable(graph, layer, route):
    """Tell whether the targets can be served in this order, along some of their segments."""
    clusters = [[i for i in graph.C(u) if graph.layer[i] == layer] for u in route]
    return any(earliest_times(graph, segments) is not None for segments in itertools.product(*clusters))


def _shortest(graph, layer, route, network):
    """Return the least length of a path through points of a route's targets, one after the other, infinite if it cannot
    be flown at any times."""
    if not _flyable(graph, layer, route):
        return math.inf
    points = [range(network.start[u], network.start[u + 1]) for u in route]
    length = {g: network.between[-1, g] for g in points[0]}
    for following in points[1:]:
        length = {h: min(length[g] + network.between[g, h] for g in length) for h in following}
    return min(length[g] + network.between[g, -1] for g in length)


@pytest.mark.parametrize("seed", SEEDS)
def test_points_lie_on_all_segments_of_the_first_layer_ends_included(seed):
    graph, _, node, time, start, step = _grid(seed)
    for u in range(5):
        own = range(start[u], start[u + 1])
        assert {int(node[g]) for g in own} == {int(i) for i in graph.C(u) if graph.layer[i] == 0}
        for i in {node[g] for g in own}:
            times = [time[g] for g in own if node[g] == i]
            assert times[0] == graph.t_lo[i] and times[-1] == graph.t_hi[i]
            assert all(0 < later - sooner <= step * (1 + 1e-9) for sooner, later in itertools.pairwise(times))


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("slack, charge", [(0.0, 0.0), (0.5, 0.0), (1.0, 0.7)])
def test_flights_are_distances_and_what_is_charged_where_time_is_short(seed, slack, charge):
    graph, networks, node, time, start, step = _grid(seed, slack, charge)
    late = slack * step + TIME_SLACK * graph.horizon
    owner = [u for u in range(5) for _ in range(start[u], start[u + 1])]

    def expected(d, speed, available):
        short = max(d - speed * available, 0.0)
        return pytest.approx(d + charge * short) if short <= speed * late else math.inf

    for k in range(graph.n_layers):
        network, speed = of_layer(networks, k), graph.speeds[k]
        depot, end = graph.p_lo[graph.starts[k]], graph.p_lo[graph.ends[k]]
        place = [graph.position(i, t) for i, t in zip(node, time)]
        for g, h in itertools.product(range(0, len(node), 3), range(len(node))):
            flight = expected(math.dist(place[g], place[h]), speed, time[h] - time[g])
            assert network.between[g, h] == network.back[h, g] == (flight if owner[g] != owner[h] else math.inf)
        for g in range(len(node)):
            out, home = math.dist(depot, place[g]), math.dist(place[g], end)
            assert network.between[-1, g] == network.back[g, -1] == expected(out, speed, time[g])
            assert network.between[g, -1] == network.back[-1, g] == expected(home, speed, graph.horizon - time[g])
        assert network.start.tolist() == [*start, len(node) + 1] and len(network.between) == len(node) + 1
        for u, w in itertools.permutations(range(6), 2):  # with the depot and the end
            block = network.between[network.start[u] : network.start[u + 1], network.start[w] : network.start[w + 1]]
            assert network.near[u, w] == block.min()


@pytest.mark.parametrize("seed", SEEDS)
def test_a_route_costs_its_shortest_path_and_its_segments_can_be_flown(seed):
    rng = np.random.default_rng(seed)
    graph, networks, _, _, start, _ = _grid(seed)
    values, *_ = _room(5, start)
    segments, found = np.zeros(5, np.int64), 0
    of_first_layer = [i for u in range(5) for i in graph.C(u) if graph.layer[i] == 0]
    for k, (row, length) in itertools.product(range(graph.n_layers), _some_routes(rng, 5)):
        network, route = of_layer(networks, k), row[:length]
        expected = _shortest(graph, k, route, network)
        assert evaluate(row, length, network, values, 0, 0) == pytest.approx(expected)
        if math.isfinite(expected):
            trace(row, length, network, values, segments)
            way = [of_first_layer[s] + int(graph.starts[k]) for s in segments[:length]]
            assert graph.tau[way].tolist() == route.tolist() and earliest_times(graph, way) is not None
            found += 1
    assert found > 3


@pytest.mark.parametrize("seed", SEEDS)
def test_what_holds_already_is_not_filled_in_anew(seed):
    rng = np.random.default_rng(seed)
    graph, networks, _, _, start, _ = _grid(seed)
    for k, (row, length) in itertools.product(range(graph.n_layers), _some_routes(rng, 5)):
        network, (values, *_) = of_layer(networks, k), _room(5, start)
        i = int(rng.integers(length))
        without = np.append(np.delete(row, i), row[i])
        if math.isinf(evaluate(without, length - 1, network, values, 0, 0)):
            continue
        expected = _shortest(graph, k, row[:length], network)
        assert evaluate(row, length, network, values, i, length - 1 - i) == pytest.approx(expected)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_target_is_placed_where_that_makes_its_route_least_longer(seed):
    rng = np.random.default_rng(seed)
    graph, networks, _, _, start, _ = _grid(seed)
    layer, room, placed = np.arange(2), graph.room, 0
    per_route = List(of_layer(networks, k) for k in layer)
    for _ in range(10):
        dealt, cut, w = rng.permutation(5), int(rng.integers(5)), 0
        rows = [[u for u in dealt[:cut] if u != w], [u for u in dealt[cut:] if u != w]]
        routes, length = np.full((2, 5), w), np.array([len(row) for row in rows])
        values = List(_room(5, start)[0] for _ in layer)
        for k, row in enumerate(rows):
            routes[k, : len(row)] = row
        cost = np.array([evaluate(routes[k], length[k], per_route[k], values[k], 0, 0) for k in layer])
        if not np.isfinite(cost).all():
            continue
        longer = {
            (k, i): _shortest(graph, k, [*row[:i], w, *row[i:]], per_route[k]) - cost[k]
            for k, row in enumerate(rows)
            for i in range(len(row) + 1)
            if graph.demands[[w, *row]].sum() <= room[k]
        }
        arrive, leave = _room(5, start)[1:]
        found = _place(w, routes, length, cost, per_route, values, layer, graph.demands, room, 0.0, arrive, leave)
        least = min(longer.values(), default=math.inf)
        assert (found[0] < 0) == math.isinf(least)
        if math.isfinite(least):
            assert longer[found] == pytest.approx(least, abs=1e-9)
            placed += 1
    assert placed
