"""Damage: one value of an assignment is moved, and the families that have to notice it do."""

import numpy as np
import pytest

from mamttsp import build_graph, generate
from mamttsp.formulations import build_formulation
from mamttsp.formulations.equations import EQUATIONS
from mamttsp.formulations.points import assign, segment_of
from mamttsp.formulations.residuals import residuals
from mamttsp.timing import best_tours
from tests.models import MODELERS, MODELS, some_routes

TOLERANCE = 1e-6

#: (method, variable, which of its entries, by how much it is moved): the families that notice
DAMAGE = {
    ("baseline", "y", "second start", 1): {"depot_flow_out", "target_flow_in", "flow_conservation", "big_m"},
    ("baseline", "y", "second end", 1): {"depot_flow_in", "flow_conservation", "big_m"},
    ("baseline", "y", "hop", -1): {"target_flow_in", "flow_conservation", "big_m"},
    ("baseline", "y", "hop", -0.5): {"target_flow_in", "flow_conservation", "big_m", "integrality"},
    ("baseline", "t", "node", 500): {"node_time_window", "speed", "displacement"},
    ("baseline", "l", "hop", 2000): {"speed", "big_m"},
    ("baseline", "l", "hop", -2000): {"big_m", "bounds"},
    ("baseline", "l_xy", "hop", 500): {"displacement", "norm"},
    ("baseline", "l_bar", "hop", -0.5): {"big_m", "norm"},
    ("nonconvex", "y", "second start", 1): {
        "depot_flow_out",
        "target_flow_in",
        "flow_conservation",
        "product_z_p_prime",
        "product_z_t_prime",
    },
    ("nonconvex", "y", "second end", 1): {
        "depot_flow_in",
        "flow_conservation",
        "product_z_p",
        "product_z_t",
        "product_z_t_prime",
    },
    ("nonconvex", "t", "node", 500): {"node_time_window", "node_position", "product_z_t", "product_z_t_prime"},
    ("nonconvex", "p", "node", 1): {"node_position", "product_z_p", "product_z_p_prime"},
    ("nonconvex", "l", "hop", 2000): {"speed"},
    ("nonconvex", "l", "hop", -0.5): {"norm"},
    ("nonconvex", "l_xy", "hop", 500): {"displacement", "norm"},
    ("nonconvex", "z_p", "hop", 1): {"displacement", "product_z_p"},
    ("nonconvex", "z_p_prime", "hop", 1): {"displacement", "product_z_p_prime"},
    ("nonconvex", "z_t", "hop", 500): {"speed", "product_z_t"},
    ("nonconvex", "z_t_prime", "hop", -500): {"speed", "product_z_t_prime"},
    ("micp", "alpha", None, 3): {"flow_from_depot", "flow_to_depot", "number_of_agents"},
    ("micp", "alpha", None, -0.5): {"flow_from_depot", "flow_to_depot", "number_of_agents", "integrality"},
    ("micp", "y", "hop", -1): {
        "one_segment_per_cluster",
        "flow_conservation",
        "time_at_tail",
        "time_at_head",
        "position_at_tail",
        "position_at_head",
    },
    ("micp", "l", "hop", 2000): {"speed"},
    ("micp", "l", "hop", -0.5): {"norm"},
    ("micp", "l_xy", "hop", 500): {"displacement", "norm"},
    ("micp", "z_p", "hop", 1): {"displacement", "position_at_tail"},
    ("micp", "z_p_prime", "hop", 1): {"displacement", "position_at_head"},
    ("micp", "z_t", "hop", 500): {"time_conservation", "time_at_tail", "position_at_tail", "speed"},
    ("micp", "z_t_prime", "hop", -500): {"time_conservation", "time_at_head", "position_at_head", "speed"},
}


@pytest.fixture(scope="module")
def tour():
    """One agent's tour through four targets that move, and its graph."""
    graph = build_graph(generate(4, 20, seed=5))
    return graph, best_tours(graph, some_routes(graph, 1))[1]


def entry(graph, tours, which):
    """Return the index of the edge or node, in the arrays, that is named in DAMAGE."""
    route = [segment_of(graph, visit.target, visit.time) for visit in tours[0].visits]
    edges = {
        "second start": (graph.s, route[1]),
        "second end": (route[1], graph.s_prime),
        "hop": (route[0], route[1]),
    }
    return route[1] if which == "node" else graph.edges.tolist().index(list(edges[which]))


def move(formulation, name, index, change):
    """Change the first value that a variable has for this edge or node."""
    variable = getattr(formulation.model, name)
    if formulation.modeler == "pyomo":
        length = len(formulation.graph.tau) if name in ("t", "p") else len(formulation.graph.edges)
        entries = list(variable.values())
        chosen = entries[0 if index is None else index * len(entries) // length]
        chosen.set_value(chosen.value + change, skip_validation=True)
    else:
        variable = variable[0] if isinstance(variable, list) else variable
        values = np.array(variable.value)
        values[() if index is None else np.unravel_index(index * (values.size // len(values)), values.shape)] += change
        variable.save_value(values)


@pytest.mark.parametrize("damage, modeler", [(damage, m) for damage in DAMAGE for m in MODELERS[damage[0]]])
def test_damage_is_noticed_by_the_right_families(tour, damage, modeler):
    method, name, which, change = damage
    graph, tours = tour
    formulation = build_formulation(method, modeler, graph, 1)
    assign(formulation, tours)
    move(formulation, name, None if which is None else entry(graph, tours, which), change)
    assert {family for family, worst in residuals(formulation.model).items() if worst > TOLERANCE} == DAMAGE[damage]


@pytest.mark.parametrize("method", EQUATIONS)
def test_the_damage_covers_every_family(method):
    noticed = set().union(*(families for damage, families in DAMAGE.items() if damage[0] == method))
    assert noticed >= set(EQUATIONS[method])


@pytest.mark.parametrize("method, modeler", MODELS)
def test_a_value_out_of_bounds_or_missing(tour, method, modeler):
    formulation = build_formulation(method, modeler, tour[0], 1)
    assert set(residuals(formulation.model).values()) == {np.inf}
    assign(formulation, tour[1])
    move(formulation, "y", 0, 7)
    assert residuals(formulation.model)["bounds"] >= 6


@pytest.mark.parametrize("method, modeler", MODELS)
def test_a_cycle_that_misses_the_depot_breaks_its_cut(tour, method, modeler):
    graph, tours = tour
    formulation = build_formulation(method, modeler, graph, 1)
    u, v = (visit.target for visit in tours[0].visits[:2])
    formulation.add_subtour_cut([u, v])
    assign(formulation, tours)
    assert residuals(formulation.model)["subtour_cuts"] == 0.0
    back = [segment_of(graph, visit.target, visit.time) for visit in reversed(tours[0].visits[:2])]
    move(formulation, "y", graph.edges.tolist().index(back), 1)
    assert residuals(formulation.model)["subtour_cuts"] == 1.0
