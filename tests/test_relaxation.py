"""Relaxed bounds: the same from both modelers, below the optimum, and nothing at all from the baseline."""

import dataclasses
import math

import numpy as np
import pytest

from mamttsp import InputError, build_graph, generate
from mamttsp.conic_solver import minimise
from mamttsp.formulations import build_formulation
from mamttsp.formulations.points import assign
from mamttsp.relaxation import _magnitudes, relax, relaxation
from mamttsp.timing import best_tours
from tests.examples import instance, still
from tests.models import some_routes
from tests.oracle import optimum

MODELERS = ("cvxpy", "pyomo")
CASES = [(2, 40, 1, 0), (3, 20, 2, 3), (4, 20, 3, 3), (4, 60, 2, 1)]
UNREACHABLE = still(50, 0, ((0.0, 5.0),))


@pytest.mark.parametrize("n, window, m, seed", CASES)
def test_both_modelers_and_pruning_give_one_bound(n, window, m, seed):
    problem = generate(n, window, m, seed)
    bounds = [relax(problem, "micp", modeler, prune) for modeler in MODELERS for prune in (False, True)]
    assert bounds == pytest.approx([bounds[0]] * 4, rel=1e-5)


@pytest.mark.parametrize("n, window, m, seed", CASES)
def test_the_bound_is_a_bound_and_says_something(n, window, m, seed):
    problem = generate(n, window, m, seed)
    assert 0.3 * optimum(problem) < relax(problem) <= optimum(problem)


def test_with_no_choice_left_the_relaxation_is_the_tour():
    assert 20.0 - 1e-4 <= relax(instance(still(6, 8))) <= 20.0


@pytest.mark.parametrize("modeler", MODELERS)
@pytest.mark.parametrize("n, window, m, seed", CASES)
def test_the_baselines_relaxation_is_zero(modeler, n, window, m, seed):
    problem = generate(n, window, m, seed)
    assert relax(problem, "baseline", modeler) == pytest.approx(0.0, abs=1e-6)
    program = build_formulation("baseline", modeler, build_graph(problem), m).conic_program().relaxed()
    answer = minimise(program.c, program.A, program.b, program.n_zero, program.n_nonneg)
    assert answer.obj_val == pytest.approx(0.0, abs=1e-6)  # attained: not only a bound that says nothing


def test_the_proof_of_the_baseline_s_bound_allows_for_its_big_m():
    """At tours, where every l_bar not flown is R or more, no variable is larger than the proof takes it to be."""
    wide = dataclasses.replace(generate(3, 20, 2, seed=3), R=5000.0)
    formulation = build_formulation("baseline", "cvxpy", build_graph(wide), 2)
    program = formulation.conic_program()  # before there are values: it takes them away
    assign(formulation, best_tours(formulation.graph, some_routes(formulation.graph, 2))[1])
    most = _magnitudes(program, formulation.graph, 2)
    for variable in formulation.model.problem.variables():
        columns = program.columns[variable.name()]
        assert (np.abs(variable.value) <= most[columns].reshape(variable.shape)).all(), variable.name()
    assert relax(wide, "baseline") == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("modeler", MODELERS)
def test_a_cut_is_in_the_program(modeler):
    formulation = build_formulation("micp", modeler, build_graph(generate(3, 20, 2, seed=3)), 2)
    before = formulation.conic_program()
    formulation.add_subtour_cut([0, 2])
    assert formulation.conic_program().n_nonneg == before.n_nonneg + 1


@pytest.mark.parametrize("modeler", MODELERS)
def test_the_values_are_a_point_of_the_relaxation(modeler):
    formulation = build_formulation("micp", modeler, build_graph(generate(4, 60, 2, seed=1)), 2)
    found = relaxation(formulation)
    assert found.values["l"].sum() == pytest.approx(found.bound, rel=1e-5)
    tail, head = formulation.graph.edges.T
    for u in range(4):
        into, out_of = np.isin(head, formulation.graph.C(u)), np.isin(tail, formulation.graph.C(u))
        assert found.values["y"][into].sum() == pytest.approx(1.0, abs=1e-6)
        assert found.values["z_t_prime"][into].sum() == pytest.approx(found.values["z_t"][out_of].sum(), rel=1e-6)


def test_a_family_that_is_switched_off_no_longer_counts():
    formulation = build_formulation("micp", "pyomo", build_graph(generate(4, 60, 2, seed=1)), 2)
    bound = relaxation(formulation).bound
    formulation.model.time_conservation.deactivate()
    assert relaxation(formulation).bound < 0.99 * bound


@pytest.mark.parametrize("modeler", MODELERS)
def test_an_infeasible_relaxation_is_infinite(modeler):
    assert relax(instance(still(5, 0), UNREACHABLE), "micp", modeler) == math.inf


def test_a_method_without_a_relaxation_is_refused():
    with pytest.raises(InputError, match="^method: expected one of micp, baseline"):
        relax(instance(still(5, 0)), "nonconvex")
