"""Time prices: they make relaxed times as long as the route, and no prices make them longer."""

import numpy as np
import pytest

from mamttsp import build_graph, generate, solve
from mamttsp.study.time_prices import pinned_lengths, relaxed_times, time_prices
from mamttsp.timing import best_times
from tests.examples import instance, still


@pytest.fixture(scope="module", params=[(4, 40, 1), (5, 60, 6), (5, 40, 33)])
def flown(request):
    """A graph and a best route of its instance."""
    n, window, seed = request.param
    problem = generate(n, window, seed=seed)
    graph, (tour,) = build_graph(problem), solve(problem).tours
    fits = [(graph.t_lo[graph.C(v.target)] <= v.time) & (v.time <= graph.t_hi[graph.C(v.target)]) for v in tour.visits]
    return graph, [int(graph.C(v.target)[np.flatnonzero(fit)[0]]) for v, fit in zip(tour.visits, fits)]


def test_the_length_is_that_of_the_best_times(flown):
    graph, route = flown
    length, times, mu = time_prices(graph, route)
    expected, best = best_times(graph, route)
    assert length == pytest.approx(expected, rel=1e-6) and mu.shape == times.shape == best.shape
    assert (times >= graph.t_lo[route] - 1e-6).all() and (times <= graph.t_hi[route] + 1e-6).all()


def test_at_the_prices_relaxed_times_cost_as_much_as_the_route(flown):
    graph, route = flown
    length, _, mu = time_prices(graph, route)
    bound, arrive, leave = relaxed_times(graph, route, mu)
    assert bound == pytest.approx(length, rel=1e-6)
    assert arrive.shape == leave.shape == (len(route),)


def test_no_prices_make_relaxed_times_longer_than_the_route(flown):
    graph, route = flown
    length, times, mu = time_prices(graph, route)
    rng = np.random.default_rng(0)
    for scale in (0.01, 0.3, 3.0):
        assert relaxed_times(graph, route, mu + rng.normal(0, scale, len(route)))[0] <= length * (1 + 1e-6)
    narrow = relaxed_times(graph, route, 0 * mu, times - 0.5, times + 0.5)[0]
    assert relaxed_times(graph, route, 0 * mu)[0] - 1e-6 <= narrow <= length * (1 + 1e-6)


def test_a_pinned_visit_splits_the_route_in_two(flown):
    graph, route = flown
    length, times, _ = time_prices(graph, route)
    for k in range(len(route)):
        so_far, to_go = pinned_lengths(graph, route, k, [times[k], graph.t_lo[route[k]]])
        total = so_far + to_go
        assert total[0] == pytest.approx(length, rel=1e-4) and total[1] >= length * (1 - 1e-6)


def test_what_cannot_be_flown_is_infinite_or_an_error():
    graph = build_graph(instance(still(40, 0, [(5, 30)]), still(-40, 0, [(5, 40)])))
    so_far, to_go = pinned_lengths(graph, [1, 2], 0, [5.0, 10.0, 25.0])
    assert np.isinf(so_far).tolist() == np.isinf(to_go).tolist() == [True, False, True]
    assert so_far[1] == pytest.approx(40.0) and to_go[1] == pytest.approx(120.0)
    with pytest.raises(ValueError, match="no times can be flown"):
        time_prices(graph, [2, 1, 2])
