"""Tours carried into each formulation: feasible there, and of the same length; and out of it what was put in."""

import pytest

from mamttsp import InputError, Tour, Visit, build_graph, check, generate
from mamttsp.backends.scip import solve
from mamttsp.flow import read_flow
from mamttsp.formulations import build_formulation
from mamttsp.formulations.equations import EQUATIONS
from mamttsp.formulations.points import assign, recover, segment_of
from mamttsp.formulations.residuals import objective, residuals
from mamttsp.options import Options
from mamttsp.study.meetings import passing
from mamttsp.timing import best_tours
from tests.models import MODELS, some_routes
from tests.oracle import optimum

TOLERANCE = 1e-6


def assert_carried(graph, n_agents, tours, length):
    for method, modeler in MODELS:
        formulation = build_formulation(method, modeler, graph, n_agents)
        assign(formulation, tours)
        found = residuals(formulation.model)
        assert set(found) == {*EQUATIONS[method], "bounds", "integrality"}
        assert max(found.values()) < TOLERANCE, (method, modeler, found)
        assert objective(formulation.model) == pytest.approx(length, rel=TOLERANCE)


@pytest.mark.parametrize("m", [1, 2, 3])
@pytest.mark.parametrize("method", EQUATIONS)
def test_the_optimum_of_each_formulation_is_one_of_all_others(method, m):
    """The proof of validity in numbers, the optimum itself from enumeration."""
    instance = generate(3, 16, m, seed=20 + m)
    graph = build_graph(instance)
    answer = solve(build_formulation(method, "pyomo", graph, m), Options(gap=1e-6))
    paths, cycles = read_flow(graph, answer.flow)
    assert not cycles
    length, tours = best_tours(graph, [list(path) for path in paths])
    assert answer.objective == pytest.approx(length, rel=1e-4)
    assert length == pytest.approx(optimum(instance), rel=TOLERANCE)
    assert_carried(graph, m, tours, length)


@pytest.mark.parametrize("m, prune", [(1, False), (2, True)])
@pytest.mark.parametrize("seed", [1, 2])
def test_any_tours_can_be_carried(seed, m, prune):
    """Larger instances, tours that are not optimal, and fewer tours than agents."""
    instance = generate(6, 60, m, seed)
    graph = build_graph(instance, prune)
    length, tours = best_tours(graph, some_routes(graph, m))
    assert check(instance, tours) == pytest.approx(length)
    assert_carried(graph, m, tours, length)
    assert_carried(graph, m + 1, [*tours, Tour((), 0.0)], length)  # an agent that stays at the depot


def test_the_segment_of_a_visit():
    graph = build_graph(generate(5, 60, seed=0))
    for i in graph.V_seg:
        assert segment_of(graph, graph.tau[i], (graph.t_lo[i] + graph.t_hi[i]) / 2) == i
        assert segment_of(graph, graph.tau[i], graph.t_lo[i]) in (i, i - 1)  # a bend belongs to both its segments


def test_tours_that_have_no_assignment():
    instance = generate(4, 20, 2, seed=5)
    graph = build_graph(instance)
    length, tours = best_tours(graph, some_routes(graph, 2))
    with pytest.raises(InputError, match="3 tours for 2 agents"):
        assign(build_formulation("micp", "pyomo", graph, 2), [tours[0]] * 3)
    with pytest.raises(InputError, match="no edge from node"):
        assign(build_formulation("micp", "pyomo", graph, 2), [Tour(tours[0].visits[:1] * 2, 100.0)])


HOME = Tour((Visit(0, 2.5, (10.0, 0.0)),), 5.0)
CYCLE = (Visit(1, 50.0, (60.0, 0.0)), Visit(2, 50.0, (60.0, 0.0)))


def numbers(visits):
    return [(visit.target, pytest.approx(visit.time), pytest.approx(visit.position)) for visit in visits]


@pytest.mark.parametrize("method, modeler", MODELS)
def test_recover_undoes_assign(method, modeler):
    instance = generate(6, 40, 3, seed=3)
    graph = build_graph(instance)
    tours = best_tours(graph, some_routes(graph, 2))[1]
    formulation = build_formulation(method, modeler, graph, 3)
    assign(formulation, tours)
    found, cycles = recover(formulation)
    assert cycles == () and len(found) == len(tours)
    for tour in tours:
        same = next(other for other in found if other.visits[0].target == tour.visits[0].target)
        assert [(v.target, v.time, v.position) for v in same.visits] == numbers(tour.visits)
        assert same.return_time == pytest.approx(tour.return_time)


@pytest.mark.parametrize("method, modeler", MODELS)
def test_cycles_are_recovered_as_cycles(method, modeler):
    formulation = build_formulation(method, modeler, build_graph(passing()), 2)
    assign(formulation, [HOME], [CYCLE])
    (tour,), (cycle,) = recover(formulation)
    assert [(v.target, v.time, v.position) for v in tour.visits] == numbers(HOME.visits)
    assert [(v.target, v.time, v.position) for v in cycle] == numbers(CYCLE)


def test_the_times_are_the_solvers_own():
    instance = generate(3, 16, 2, seed=1)
    formulation = build_formulation("micp", "pyomo", build_graph(instance), 2)
    answer = solve(formulation, Options())
    assert check(instance, recover(formulation).tours) == pytest.approx(answer.objective, rel=1e-5)
