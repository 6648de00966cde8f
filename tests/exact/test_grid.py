"""Routes on a time grid against plain Python: values are shortest paths through layers of points."""

import itertools
import math

import numpy as np
import pytest

from mamttsp import build_graph, generate
from mamttsp.exact.grid import Values, evaluate, grid_points, insertion, make_networks, of_layer, trace
from mamttsp.motion import TIME_SLACK
from tests.exact.networks import unlike

SEEDS = range(6)


def _grid(seed, slack=0.5):
    """Return (graph, Networks, node, time, start, step) of an instance with two types of agents."""
    graph = unlike(seed, n=5, window=60)
    node, time, start, step = grid_points(graph, range(5), 6)
    return graph, make_networks(graph, node, time, start, slack * step), node, time, start, step


def _room(n, start):
    widest = int(np.diff(start).max())
    """Return (values, arrive, leave), wrong but for the 0 of the depot and the end, so that whoever reads others is
    found out."""
    rows, least = np.full((2, n + 1, widest), -1e6), np.full((2, n + 1), -1e6)
    rows[:, 0, 0], least[:, 0] = 0.0, 0.0
    return Values(*rows, *least), *np.full((2, widest), -1e6)


def _some_routes(rng, n):
    """Return (row, length) of routes; behind a route its row goes on with other targets."""
    return [(rng.permutation(n), int(rng.integers(1, n))) for _ in range(15)]


def _shortest(route, network):
    """Return the least length of a path through points of a route's targets, one after the other."""
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
@pytest.mark.parametrize("slack", [0.0, 0.5, 1.0])
def test_flights_are_distances_where_there_is_time(seed, slack):
    graph, networks, node, time, start, step = _grid(seed, slack)
    late = slack * step + TIME_SLACK * graph.horizon
    owner = [u for u in range(5) for _ in range(start[u], start[u + 1])]
    for k in range(graph.n_layers):
        network, speed = of_layer(networks, k), graph.speeds[k]
        depot, end = graph.p_lo[graph.starts[k]], graph.p_lo[graph.ends[k]]
        place = [graph.position(i, t) for i, t in zip(node, time)]
        for g, h in itertools.product(range(0, len(node), 3), range(len(node))):
            d = math.dist(place[g], place[h])
            there = owner[g] != owner[h] and d <= speed * (time[h] - time[g] + late)
            assert network.between[g, h] == network.back[h, g] == (pytest.approx(d) if there else math.inf)
        for g in range(len(node)):
            out, home = math.dist(depot, place[g]), math.dist(place[g], end)
            first = pytest.approx(out) if out <= speed * (time[g] + late) else math.inf
            assert network.between[-1, g] == network.back[g, -1] == first
            in_time = home <= speed * (graph.horizon - time[g] + late)
            assert network.between[g, -1] == network.back[-1, g] == (pytest.approx(home) if in_time else math.inf)
        assert network.start.tolist() == [*start, len(node) + 1] and len(network.between) == len(node) + 1
        for u, w in itertools.permutations(range(6), 2):  # with the depot and the end
            block = network.between[network.start[u] : network.start[u + 1], network.start[w] : network.start[w + 1]]
            assert network.near[u, w] == block.min()


@pytest.mark.parametrize("seed", SEEDS)
def test_a_route_costs_its_shortest_path_and_its_points_are_one(seed):
    rng = np.random.default_rng(seed)
    graph, networks, _, _, start, _ = _grid(seed)
    values, *_ = _room(5, start)
    points, found = np.zeros(5, np.int64), 0
    for k, (row, length) in itertools.product(range(graph.n_layers), _some_routes(rng, 5)):
        network, route = of_layer(networks, k), row[:length]
        expected = _shortest(route, network)
        assert evaluate(row, length, network, values) == pytest.approx(expected)
        if math.isfinite(expected):
            trace(row, length, network, values, points)
            way = points[:length].tolist()
            assert all(start[u] <= g < start[u + 1] for u, g in zip(route, way))
            legs = sum(network.between[g, h] for g, h in itertools.pairwise(way))
            assert network.between[-1, way[0]] + legs + network.between[way[-1], -1] == pytest.approx(expected)
            found += 1
    assert found > 3


@pytest.mark.parametrize("seed", SEEDS)
def test_an_insertion_costs_what_the_longer_route_does_unless_it_is_cut_off(seed):
    rng = np.random.default_rng(seed)
    graph, networks, _, _, start, _ = _grid(seed)
    values, arrive, leave = _room(5, start)
    finite = 0
    for k, (row, length) in itertools.product(range(graph.n_layers), _some_routes(rng, 5)):
        network, route = of_layer(networks, k), row[:length]
        if math.isinf(evaluate(row, length, network, values)):
            continue
        for w, i in itertools.product(set(range(5)) - set(route.tolist()), range(length + 1)):
            expected = _shortest([*route[:i], w, *route[i:]], network)
            assert insertion(w, row, length, i, network, values, arrive, leave, math.inf) == pytest.approx(expected)
            cutoff = 0.9 * expected if math.isfinite(expected) else 100.0
            assert insertion(w, row, length, i, network, values, arrive, leave, cutoff) >= cutoff
            finite += math.isfinite(expected)
    assert finite > 3


def test_an_insertion_below_the_cutoff_is_priced():
    graph = build_graph(generate(3, 60, seed=1))
    _, _, start, step = points = grid_points(graph, range(3), 8)
    network = of_layer(make_networks(graph, *points[:3], step), 0)
    values, arrive, leave = _room(3, start)
    row = np.arange(3)
    evaluate(row, 1, network, values)
    (least, w, i) = min((_shortest(r, network), w, r.index(w)) for w in (1, 2) for r in ([w, 0], [0, w]))
    assert insertion(w, row, 1, i, network, values, arrive, leave, least * (1 + 1e-9)) == pytest.approx(least)
