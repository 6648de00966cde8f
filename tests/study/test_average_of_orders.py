"""The average of all orders: it is that average, and the baseline without whole numbers accepts it at no cost."""

import itertools

import numpy as np
import pytest

from mamttsp import build_graph, generate
from mamttsp.formulations import build_formulation
from mamttsp.formulations.residuals import objective, residuals
from mamttsp.study.average_of_orders import assign_average, average_of_orders
from tests.examples import instance, moving, still


def test_it_is_the_average_of_all_orders_and_segments():
    graph = build_graph(instance(still(10, 0, [(0, 20), (30, 40)]), still(0, 10), moving((5, 5), (0.1, 0), [(0, 9)])))
    flow, number = np.zeros(len(graph.edges)), {tuple(edge): e for e, edge in enumerate(graph.edges.tolist())}
    routes = [
        route
        for order in itertools.permutations(range(graph.n_targets))
        for route in itertools.product(*(graph.C(u).tolist() for u in order))
    ]
    for route in routes:
        for edge in zip((graph.s, *route), (*route, graph.s_prime)):
            flow[number[edge]] += 1.0 / len(routes)
    assert average_of_orders(graph) == pytest.approx(flow, abs=1e-12)


@pytest.mark.parametrize("n_agents", [1, 3])
def test_only_whole_numbers_are_missing_and_it_costs_nothing(n_agents):
    graph = build_graph(generate(5, 40, seed=3))
    formulation = build_formulation("baseline", "pyomo", graph, n_agents)
    assign_average(formulation)
    found = residuals(formulation.model)
    assert found.pop("integrality") > 0.01
    assert max(found.values()) < 1e-9
    assert objective(formulation.model) == 0.0
