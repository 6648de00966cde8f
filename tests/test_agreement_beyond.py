"""Every method, modeler and back end finds the optimum of unlike agents with capacities that enumeration finds."""

import dataclasses
import math

import pytest

from mamttsp import Instance, solve
from tests.examples import agents, general, still
from tests.general_instances import FAST, SLOW, random_general
from tests.oracle import optimum
from tests.routes import assert_optimal, every_route


def assert_agrees(problem, route):
    if math.isfinite(optimum(problem)):
        assert_optimal(problem, route)
    else:
        method, modeler, solver = route
        solution = solve(problem, method=method, modeler=modeler, solver=solver)
        assert (solution.status, solution.tours, solution.objective) == ("infeasible", (), None)


@every_route
@pytest.mark.parametrize("n, n_types, seed", FAST)
def test_every_route_agrees(n, n_types, seed, route):
    assert_agrees(random_general(n, n_types, seed), route)


@pytest.mark.slow
@every_route
@pytest.mark.parametrize("n, n_types, seed", SLOW)
def test_every_route_agrees_on_more_instances(n, n_types, seed, route):
    assert_agrees(random_general(n, n_types, seed), route)


def test_types_depots_ends_and_capacities_matter_among_these():
    """Without such instances the agreement would say nothing of how formulations tell agents apart."""
    problems = [random_general(*which) for which in FAST]
    first = [optimum(Instance(p.targets, agents=p.agents[:1], horizon=p.horizon)) for p in problems]
    free = [optimum(_with_types(p, capacity=None)) for p in problems]
    home = [optimum(_with_types(p, end=None)) for p in problems]
    found = [optimum(p) for p in problems]
    assert sum(best < one * 0.999 for best, one in zip(found, first)) >= 8
    assert sum(best * 0.999 > light for best, light in zip(found, free)) >= 8
    assert sum(abs(best - back) > 0.001 * back for best, back in zip(found, home) if math.isfinite(best)) >= 8
    assert sum(map(math.isinf, found)) >= 2
    assert len({tuple(entry.depot) for p in problems for entry in p.agents}) > 20


def _with_types(problem, **changes):
    return dataclasses.replace(problem, agents=[dataclasses.replace(entry, **changes) for entry in problem.agents])


@pytest.mark.parametrize("n, n_types, seed", FAST[12:18])
def test_pruned_edges_change_nothing(n, n_types, seed):
    problem = random_general(n, n_types, seed)
    assert solve(problem, method="micp", prune=True).objective == pytest.approx(optimum(problem), rel=1e-4)


@pytest.mark.parametrize("method", ["exact", "micp"])
def test_a_tour_names_its_type_where_the_instance_has_types(method):
    near, far = agents(1, (0.0, 0.0)), agents(1, (90.0, 0.0), max_speed=9.0, end=(80.0, 0.0))
    solution = solve(general(still(10, 0), still(85, 0), types=[near, far]), method=method)
    assert sorted((tour.agent, tour.visits[0].target) for tour in solution.tours) == [(0, 0), (1, 1)]
    assert solution.to_dict()["version"] == 2
    assert solution.objective == pytest.approx(20 + 10)
