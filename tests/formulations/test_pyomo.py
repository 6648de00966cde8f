"""The Pyomo models: every equation of the paper is there, named and documented, and the wrapper around them."""

import dataclasses

import numpy as np
import pyomo.environ as pyo
import pytest

from mamttsp import InputError, build_graph, generate
from mamttsp.backends.scip import solve
from mamttsp.formulations import build_formulation
from mamttsp.formulations.equations import EQUATIONS
from mamttsp.options import Options
from tests import examples
from tests.models import MODELS

OBJECTIVES = {"baseline": 1, "nonconvex": 11, "micp": 17}


@pytest.fixture(scope="module")
def graph():
    return build_graph(generate(3, 20, seed=0))


@pytest.mark.parametrize("method", EQUATIONS)
def test_each_equation_is_a_documented_family(graph, method):
    model = build_formulation(method, "pyomo", graph, 2).model
    families = {family.local_name: family.doc for family in model.component_objects(pyo.Constraint) if len(family)}
    assert list(families) == sorted(families, key=list(EQUATIONS[method]).index)
    for name, number in EQUATIONS[method].items():
        assert families[name].startswith(f"({number}) ")
    assert model.length.doc.startswith(f"({OBJECTIVES[method]}) ")


def test_the_families_cover_the_paper():
    """Eqs (2)-(10), (2)-(6) and (12)-(16), (18)-(29); (1), (11) and (17) are the objectives."""
    numbers = {method: sorted(set(families.values())) for method, families in EQUATIONS.items()}
    assert numbers["baseline"] == [*range(2, 11)]
    assert numbers["nonconvex"] == [*range(2, 7), *range(12, 17)]
    assert numbers["micp"] == [*range(18, 30)]


def test_rows_of_the_baseline_by_hand():
    """One still target at (3, 4): with l = 5, t = 2 and both edges flown, what each row says in numbers."""
    graph = build_graph(dataclasses.replace(examples.instance(examples.still(3.0, 4.0)), R=70.0))
    model = build_formulation("baseline", "pyomo", graph, 1).model
    for v in model.component_data_objects(pyo.Var):
        v.set_value(0.0)
    model.y[0, 1, 1], model.t[1, 1], model.l[0, 1, 1] = 1, 2.0, 5.0
    assert pyo.value(model.length) == 5.0
    assert slack(model.speed[0, 1, 1]) == pytest.approx(examples.MAX_SPEED * 2.0 - 5.0)  # v_max (t_j - t_i) - l
    assert slack(model.speed[1, 2, 1]) == pytest.approx(examples.MAX_SPEED * (examples.HORIZON - 2.0))  # y = 0: big-M
    model.l_xy[0, 1, 1, 0], model.l_xy[0, 1, 1, 1] = 3.0, 4.0
    assert all(abs(slack(model.displacement[0, 1, 1, x])) < 1e-12 for x in model.XY)
    model.l_bar[0, 1, 1], model.l_bar[1, 2, 1] = 5.0, 70.0  # y = 0: R
    assert all(abs(slack(model.big_m[row])) < 1e-12 for row in [(0, 1, 1), (1, 2, 1)])
    assert slack(model.norm[0, 1, 1]) == 0.0


def slack(row):
    """Return by how much a <= row has room, the residual of an equation."""
    return pyo.value(row.upper) - pyo.value(row.body)


def test_speed_row_of_the_micp_by_hand():
    graph = build_graph(examples.instance(examples.moving((10.0, 0.0), (0.5, 0.0))))
    model = build_formulation("micp", "pyomo", graph, 1).model
    edge = 0, 1
    model.y[edge], model.z_t[edge], model.z_t_prime[edge], model.l[edge] = 1, 0.0, 6.0, 13.0
    model.z_p_prime[0, 1, 0] = 10.0 + 0.5 * 6.0
    assert slack(model.speed[edge]) == pytest.approx(examples.MAX_SPEED * 6.0 - 13.0)
    assert slack(model.position_at_head[0, 1, 0]) == pytest.approx(0.0)
    model.y[edge], model.z_t_prime[edge], model.z_p_prime[0, 1, 0] = 0, 0.0, 0.0  # the perspective of y = 0: all zero
    assert slack(model.position_at_head[0, 1, 0]) == pytest.approx(0.0)


@pytest.mark.parametrize("method, modeler", MODELS)
def test_flow_is_summed_over_agents(graph, method, modeler):
    formulation = build_formulation(method, modeler, graph, 2)
    assert np.isnan(formulation.flow()).all()
    n_edges = len(graph.edges)
    y = np.zeros(n_edges if method == "micp" else (n_edges, 2))
    y[4] = 1.0
    y.flat[-1] = 1.0
    set_y(formulation, y)
    expected = np.zeros(n_edges)
    expected[[4, -1]] = (1.0, 1.0) if method == "micp" else (2.0, 1.0)
    assert formulation.flow() == pytest.approx(expected)
    assert formulation.build_time > 0.0


def set_y(formulation, y):
    if formulation.modeler == "cvxpy":
        formulation.model.y.value = y
    else:
        formulation.model.y.set_values(dict(zip(formulation.model.y, y.flat)))


def test_edges_and_agents_are_in_the_agreed_order(graph):
    model = build_formulation("baseline", "pyomo", graph, 2).model
    assert list(model.E) == [tuple(edge) for edge in graph.edges.tolist()]
    assert list(model.y) == [(i, j, k) for i, j in graph.edges.tolist() for k in (1, 2)]


@pytest.mark.parametrize(
    "method, modeler, said",
    [
        ("simplex", "pyomo", "method: expected one of baseline, nonconvex, micp"),
        ("micp", "ampl", "modeler: expected one of pyomo, cvxpy"),
        ("nonconvex", "cvxpy", "modeler: cvxpy cannot state the nonconvex program"),
    ],
)
def test_what_cannot_be_built_is_one_clear_line(graph, method, modeler, said):
    with pytest.raises(InputError, match=said) as caught:
        build_formulation(method, modeler, graph, 1)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("method", EQUATIONS)
def test_pruning_that_leaves_a_target_without_edges_leaves_an_infeasible_model(method):
    far = examples.still(40.0, 0.0, windows=[(0.0, 1.0)])
    graph = build_graph(examples.instance(far, examples.still(1.0, 1.0)), prune=True)
    assert len(graph.into(1)) == 0
    answer = solve(build_formulation(method, "pyomo", graph, 1), Options())
    assert (answer.status, answer.flow) == ("infeasible", None)
