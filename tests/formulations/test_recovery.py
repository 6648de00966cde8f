"""Out of a model comes what was put in, and out of a solved one come tours that can be flown."""

import pytest
from models import MODELS, some_routes

from mamttsp import Tour, Visit, build_graph, check, generate
from mamttsp.backends.answer import Options
from mamttsp.backends.scip import solve
from mamttsp.formulations import build_formulation
from mamttsp.formulations.assignment import assign
from mamttsp.formulations.recovery import recover
from mamttsp.meetings import passing
from mamttsp.times import best_tours

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
