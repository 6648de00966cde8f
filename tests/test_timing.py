"""Best times for a given order against another solver."""

import itertools

import numpy as np
import pytest
from scipy.optimize import minimize

from mamttsp import build_graph, check, generate
from mamttsp.timing import best_times, best_tours, earliest_times, to_tour
from tests.examples import instance, still


def _length(graph, route, times):
    home = graph.p_lo[graph.s]
    stops = [home, *(graph.position(i, t) for i, t in zip(route, times)), home]
    return sum(np.linalg.norm(np.subtract(q, p)) for p, q in itertools.pairwise(stops))


def _by_scipy(graph, route):
    """Return the least length for the order by SLSQP from the earliest times; the problem is convex."""

    def slack(times):
        home = graph.p_lo[graph.s]
        stops = [home, *(graph.position(i, t) for i, t in zip(route, times)), home]
        moments = [0.0, *times, graph.horizon]
        legs = zip(itertools.pairwise(stops), itertools.pairwise(moments))
        return [graph.max_speed * (b - a) - np.linalg.norm(np.subtract(q, p)) for (p, q), (a, b) in legs]

    found = minimize(
        lambda times: _length(graph, route, times),
        earliest_times(graph, route),
        method="SLSQP",
        bounds=[(graph.t_lo[i], graph.t_hi[i]) for i in route],
        constraints={"type": "ineq", "fun": slack},
        options={"ftol": 1e-12, "maxiter": 500},
    )
    return found.fun


def _flyable_routes(graph, size, most):
    routes = itertools.permutations(graph.V_seg, size)
    distinct = (list(route) for route in routes if len(set(graph.tau[list(route)])) == size)
    return list(itertools.islice((route for route in distinct if earliest_times(graph, route) is not None), most))


@pytest.mark.parametrize("seed", range(4))
def test_best_times_agree_with_another_solver(seed):
    graph = build_graph(generate(4, 60, seed=seed))
    for route in _flyable_routes(graph, 3, 12):
        length, times = best_times(graph, route)
        assert length == pytest.approx(_length(graph, route, times), rel=1e-12)
        assert length == pytest.approx(_by_scipy(graph, route), rel=1e-5)


def test_best_times_are_flyable_far_within_the_tolerance():
    instance = generate(3, 40, seed=1)
    graph = build_graph(instance)
    for route in _flyable_routes(graph, 3, 20):
        length, times = best_times(graph, route)
        assert check(instance, [to_tour(graph, route, times)], tolerance=1e-7) == pytest.approx(length, rel=1e-12)


def test_an_order_that_cannot_be_flown_in_time_has_no_times():
    graph = build_graph(instance(still(10, 0, [(5, 6)]), still(-10, 0, [(5, 6)])))
    assert earliest_times(graph, [1, 2]) is None and best_times(graph, [1, 2]) is None
    assert best_tours(graph, [[1], [1, 2]]) is None
    assert earliest_times(graph, [1]) == pytest.approx([5.0])


def test_best_tours_add_up():
    graph = build_graph(instance(still(10, 0), still(-10, 0), n_agents=2))
    total, tours = best_tours(graph, [[1], [2]])
    assert total == pytest.approx(40.0) and [tour.visits[0].target for tour in tours] == [0, 1]
