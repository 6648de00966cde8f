"""Every formulation, modeler and back end finds the optimum that enumeration finds."""

import math

import pytest

from mamttsp import generate, solve
from tests.examples import instance, still
from tests.oracle import optimum
from tests.routes import assert_optimal, every_route

#: (n, total window, m, seed): twelve instances, four for each number of agents; at some of them the number matters
FAST = [
    (2, 40, 1, 0), (3, 20, 1, 1), (3, 40, 1, 2), (4, 20, 1, 3),
    (2, 60, 2, 1), (3, 20, 2, 3), (3, 40, 2, 1), (4, 20, 2, 2),
    (2, 20, 3, 3), (3, 20, 3, 4), (3, 40, 3, 3), (4, 20, 3, 3),
]  # fmt: skip
#: as large as the slowest routes still prove within minutes
SLOW = [(n, w, m, seed) for n, w in ((3, 60), (4, 40)) for m in (1, 2, 3) for seed in (5, 6)]
SLOW += [(5, 20, 1, 5), (5, 20, 2, 5), (5, 20, 3, 5), (5, 40, 1, 5), (5, 40, 1, 6)]


@every_route
@pytest.mark.parametrize("n, window, m, seed", FAST)
def test_every_route_finds_the_optimum(n, window, m, seed, route):
    assert_optimal(generate(n, window, m, seed), route)


@pytest.mark.slow
@every_route
@pytest.mark.parametrize("n, window, m, seed", SLOW)
def test_every_route_finds_the_optimum_of_larger_instances(n, window, m, seed, route):
    assert_optimal(generate(n, window, m, seed), route)


def test_the_number_of_agents_matters_somewhere():
    """Without such instances the agreement would say nothing of how formulations share targets out."""
    saved = [
        optimum(generate(n, w, 1, seed)) > 1.001 * optimum(generate(n, w, m, seed)) for n, w, m, seed in FAST if m > 1
    ]
    assert sum(saved) >= 3


@every_route
def test_every_route_tells_that_there_is_no_solution(route):
    """Two appointments at the same time far apart, and one agent."""
    method, modeler, solver = route
    nowhere = instance(still(10, 0, [(5, 6)]), still(-10, 0, [(5, 6)]))
    assert optimum(nowhere) == math.inf
    solution = solve(nowhere, method=method, modeler=modeler, solver=solver)
    assert solution.status == "infeasible" and solution.tours == () and solution.objective is None
