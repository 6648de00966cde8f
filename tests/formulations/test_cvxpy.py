"""The cvxpy programs: optima, families of constraints, vectorisation, and the one program that cvxpy cannot state."""

import dataclasses

import cvxpy as cp
import numpy as np
import pytest

from mamttsp import InputError, build_graph, generate
from mamttsp.formulations import build_formulation
from mamttsp.formulations.cvxpy import Baseline, Micp
from mamttsp.formulations.equations import EQUATIONS
from tests import examples
from tests.meetings import passing
from tests.oracle import optimum

PROGRAMS = {"micp": Micp, "baseline": Baseline}


@pytest.mark.parametrize("program", PROGRAMS.values())
@pytest.mark.parametrize("n, window, m, seed", [(2, 40, 2, 0), (3, 20, 1, 1), (3, 20, 2, 3)])
def test_the_optimum_is_that_of_enumeration(program, n, window, m, seed):
    instance = generate(n, window, m, seed)
    problem = program(build_graph(instance), m).problem
    assert problem.is_dcp() and problem.is_mixed_integer()
    assert problem.solve(solver=cp.SCIP) == pytest.approx(optimum(instance), rel=1e-5)


def test_the_baseline_takes_the_big_m_of_the_graph():
    """With y = 0 and l = 0 everywhere, row (9) makes the auxiliary length R."""
    graph = build_graph(dataclasses.replace(examples.instance(examples.still(3, 4)), R=70.0))
    built = Baseline(graph, 1)
    for variable, value in ((built.y, 0.0), (built.l, 0.0), (built.l_bar, 70.0)):
        variable.value = np.full(variable.shape, value)
    assert built.constraints["big_m"][0].violation().max() == 0.0


@pytest.mark.parametrize("method", PROGRAMS)
def test_each_equation_is_a_family_by_its_name(method):
    built = PROGRAMS[method](build_graph(generate(2, 20, seed=0)), 1)
    assert list(built.constraints) == list(EQUATIONS[method])
    assert sum(map(len, built.constraints.values())) == len(built.problem.constraints)


@pytest.mark.parametrize("program", PROGRAMS.values())
def test_the_number_of_constraint_objects_does_not_grow_with_the_edges(program):
    few, many = (program(build_graph(generate(n, 20, seed=0)), 2) for n in (2, 8))
    assert many.y.size > 10 * few.y.size
    assert len(many.problem.constraints) == len(few.problem.constraints)


@pytest.mark.parametrize("method", PROGRAMS)
def test_a_cut_against_a_cycle_makes_the_optimum_true(method):
    instance = passing(0.0)
    formulation = build_formulation(method, "cvxpy", build_graph(instance), 1)
    assert formulation.model.problem.solve(solver=cp.SCIP) == pytest.approx(20.0, abs=1e-3)
    formulation.add_subtour_cut([1, 2])
    assert len(formulation.model.constraints["subtour_cuts"]) == 1
    assert formulation.model.problem.solve(solver=cp.SCIP) == pytest.approx(optimum(instance), rel=1e-4)


def test_the_nonconvex_program_says_why_it_is_not_there():
    with pytest.raises(InputError, match=r"bilinear products .* equations \(16\).*DCP.*\"pyomo\"$"):
        build_formulation("nonconvex", "cvxpy", build_graph(generate(2, 20, seed=0)), 1)
