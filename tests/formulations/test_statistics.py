"""The counted size of each model is the closed form in n, m, |V| and |E|."""

import pytest

from mamttsp import build_graph, generate
from mamttsp.formulations import build_formulation
from mamttsp.formulations.statistics import Statistics, closed_form
from tests.models import MODELS

GRAPHS = [(2, 10, 1, False), (4, 20, 1, False), (4, 20, 3, True), (6, 40, 2, True), (6, 60, 2, False)]


@pytest.mark.parametrize("method, modeler", MODELS)
@pytest.mark.parametrize("n, window, m, prune", GRAPHS)
def test_counts_match_the_closed_form(method, modeler, n, window, m, prune):
    graph = build_graph(generate(n, window, m, seed=n), prune)
    counted = build_formulation(method, modeler, graph, m).statistics()
    assert counted == closed_form(method, n, m, len(graph.tau), len(graph.edges))


def test_the_closed_form_by_hand():
    """Two targets with one segment each: |V| = 4, |E| = 2 + 2 + 2 = 6; the rows are summed equation by equation."""
    assert closed_form("micp", 2, 3, 4, 6) == Statistics(
        variables=61,
        binaries=6,
        integers=1,
        linear_rows=2 + 2 + 2 + 4 + 12 + 12 + 12 + 12 + 6 + 12,
        cones=6,
        bilinear_rows=0,
    )
    assert closed_form("baseline", 2, 1, 4, 6) == Statistics(34, 6, 0, 1 + 1 + 2 + 2 + 8 + 6 + 12 + 6, 6, 0)
    assert closed_form("nonconvex", 2, 1, 4, 6) == Statistics(72, 6, 0, 1 + 1 + 2 + 2 + 8 + 8 + 6 + 12, 6, 36)


@pytest.mark.parametrize("method, modeler", MODELS)
def test_a_cut_is_one_linear_row(method, modeler):
    formulation = build_formulation(method, modeler, build_graph(generate(3, 20, 2, seed=0)), 2)
    before = formulation.statistics()
    formulation.add_subtour_cut([0, 2])
    assert formulation.statistics() == before._replace(linear_rows=before.linear_rows + 1)
