"""The local method: it starts and stays flyable, gets shorter at each step, and can stop above the optimum."""

import itertools

import numpy as np
import pytest

from mamttsp import build_graph, check, generate, solve
from mamttsp.study.alternating_minimisation import alternate, best_route, flyable_routes
from mamttsp.timing import best_tours
from tests.examples import instance, still

INSTANCE = generate(3, 40, seed=2)
GRAPH = build_graph(INSTANCE)
RUNS = [alternate(GRAPH, route) for route in flyable_routes(GRAPH)]


def test_each_step_is_a_flyable_tour_and_shorter_than_the_one_before():
    for run in RUNS:
        for length, route in run:
            assert check(INSTANCE, best_tours(GRAPH, [list(route)])[1]) == pytest.approx(length, rel=1e-7)
        assert all(after < before for (before, _), (after, _) in itertools.pairwise(run))
    assert any(len(run) > 1 for run in RUNS)


def test_it_never_beats_the_optimum_and_misses_it_from_some_starts():
    optimum = solve(INSTANCE).objective
    ends = np.array([run[-1][0] for run in RUNS])
    assert ends.min() == pytest.approx(optimum, rel=1e-4)
    assert (ends > 1.01 * optimum).any()


def test_the_best_route_keeps_to_the_times():
    graph = build_graph(instance(still(10, 0), still(20, 0)))
    assert best_route(graph, np.array([0.0, 10.0, 20.0, 100.0])) == [1, 2]
    assert best_route(graph, np.array([0.0, 20.0, 10.0, 100.0])) == [2, 1]
    assert best_route(graph, np.array([0.0, 10.0, 11.0, 100.0])) is None
