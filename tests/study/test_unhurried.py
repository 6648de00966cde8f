"""Unhurried column generation: its bounds are bounds, it makes whole evaluations only, and drops no arc."""

import pytest

from mamttsp import build_graph, generate
from mamttsp.study.unhurried import ascent, column_generation
from tests.oracle import optimum


@pytest.mark.parametrize("n_agents", [1, 2])
def test_bounds_rise_below_the_optimum_and_every_arc_stays(n_agents):
    instance = generate(4, 40, n_agents, seed=1)
    best, graph = optimum(instance), build_graph(instance)
    generation = column_generation(graph, 3, 5.0)
    arcs = len(generation.network.arcs.head)
    bounds = ascent(generation, best)
    assert bounds[0] < max(bounds) <= best * (1 + 1e-9) and min(bounds) > 0.0
    assert generation.best.complete and len(generation.network.arcs.head) == arcs


def test_shorter_pieces_and_longer_memories_bound_better():
    graph = build_graph(generate(4, 40, 1, seed=1))
    coarse, short, fine = (max(ascent(column_generation(graph, *how), 1e9)) for how in ((3, 10.0), (0, 2.5), (3, 2.5)))
    assert fine > coarse and fine >= short
