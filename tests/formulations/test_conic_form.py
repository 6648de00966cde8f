"""The conic program of a model: one and the same from either modeler, and what its other forms leave as it is."""

import numpy as np
import pytest

from mamttsp import build_graph, generate
from mamttsp.conic_solver import minimise
from mamttsp.formulations import MODELERS, build_formulation
from mamttsp.formulations.points import assign
from mamttsp.timing import best_tours

CASES = [(method, modeler) for method in ("baseline", "micp") for modeler in MODELERS]


def build(method, modeler):
    formulation = build_formulation(method, modeler, build_graph(generate(3, 20, 2, seed=3)), 2)
    formulation.add_subtour_cut([0, 2])
    return formulation


def point_of(formulation, program):
    """Return the x that the values of the formulation's variables are."""
    x = np.empty(len(program.c))
    for name, columns in program.columns.items():
        variable = getattr(formulation.model, name)
        parts = variable if isinstance(variable, list) else [variable]
        values = [[v.value for v in part.values()] if formulation.modeler == "pyomo" else part.value for part in parts]
        x[columns.ravel()] = np.ravel(values)
    return x


@pytest.mark.parametrize("method", ["baseline", "micp"])
def test_it_has_the_size_of_the_model_whichever_modeler_made_it(method):
    for formulation in (build(method, modeler) for modeler in MODELERS):
        program, sizes = formulation.conic_program(), formulation.statistics()
        assert len(program.c) == sizes.variables
        assert len(program.b) - program.n_linear == 3 * sizes.cones
        assert program.integer.sum() == sizes.binaries + sizes.integers
        assert (program.upper[program.columns["y"]] == 1).all() and (program.lower[program.columns["y"]] == 0).all()
        assert sorted(np.concatenate([c.ravel() for c in program.columns.values()])) == list(range(len(program.c)))


@pytest.mark.parametrize("method", ["baseline", "micp"])
def test_the_relaxations_of_both_modelers_have_one_optimum(method):
    programs = [build(method, modeler).conic_program().relaxed() for modeler in MODELERS]
    optima = [minimise(p.c, p.A, p.b, p.n_zero, p.n_nonneg).obj_val for p in programs]
    assert optima[0] == pytest.approx(optima[1], rel=1e-5, abs=1e-6)
    assert all(np.isinf(p.lower).all() and np.isinf(p.upper).all() and not p.integer.any() for p in programs)


@pytest.mark.parametrize("method, modeler", CASES)
def test_a_point_that_is_loaded_stands_in_the_variables(method, modeler):
    formulation = build(method, modeler)
    program = formulation.conic_program()
    x = np.random.default_rng(0).integers(2, size=len(program.c)).astype(float)
    program.load(x)
    y = x[program.columns["y"]].reshape(len(formulation.graph.edges), -1)
    assert formulation.flow() == pytest.approx(y.sum(axis=1))


@pytest.mark.parametrize("modeler", MODELERS)
def test_tours_are_a_point_of_the_program_and_of_the_lifted_one(modeler):
    graph = build_graph(generate(3, 20, 3, seed=3))
    length, tours = best_tours(graph, [[int(graph.C(u)[0])] for u in range(3)])
    formulation = build_formulation("micp", modeler, graph, 3)
    program = formulation.conic_program()
    assign(formulation, tours)
    x = point_of(formulation, program)
    assert program.c @ x == pytest.approx(length)
    slack = program.b - program.A @ x
    lifted, cones = program.lifted()
    wide = np.concatenate([x, slack[program.n_linear :]])
    assert len(lifted.b) == lifted.n_linear and lifted.c @ wide == pytest.approx(length)
    left = lifted.b - lifted.A @ wide
    assert np.abs(left[lifted.senses == "="]).max() < 1e-9 and left[lifted.senses == "<"].min() > -1e-9
    assert (wide >= lifted.lower - 1e-9).all() and (wide <= lifted.upper + 1e-9).all()
    assert (wide[cones[:, 0]] >= np.linalg.norm(wide[cones[:, 1:]], axis=1) - 1e-9).all()
