"""A node's bound from some of the routes: those of solutions in a lower part of the gap."""

import pytest

from mamttsp import generate
from mamttsp.exact.fleet import Fleet
from mamttsp.exact.parameters import Parameters
from mamttsp.exact.ruin_and_recreate import Annealing
from mamttsp.exact.search import Search
from mamttsp.graph import build_graph
from mamttsp.options import Watch
from tests.exact.enumeration import optimum

#: few pieces, and work enough for every enumeration
PARAMETERS = Parameters(piece=9.0, pieces_each=2, enumeration=1e6, enumeration_alone=1e6, prices=0)


def _priced(instance, clock):
    """Return the Node of all solutions, its prices moved, before there are any tours."""
    graph = build_graph(instance)
    fleet, n = Fleet.of(graph), graph.n_targets
    search = Search(graph, fleet, 1e-4, clock, PARAMETERS, Annealing(graph, range(n), fleet, PARAMETERS))
    node = search.root()
    search.nodes = [node]
    node.generation.run(None, node.limit, clock, node.raise_priced)
    return node


@pytest.mark.parametrize("m", [1, 2])
@pytest.mark.parametrize("seed", range(5))
def test_routes_of_a_lower_part_of_the_gap_raise_the_bound_but_never_above_the_optimum(seed, m):
    instance = generate(5, 40, m, seed=seed)
    shortest = optimum(instance)
    with Watch(60.0) as clock:
        node = _priced(instance, clock)
        evaluations, priced, bounds = node.generation.evaluations(0, clock), node.priced, []
        for part in (0.02, 0.1, 0.5, 0.98):
            limit = priced + part * (node.limit - priced)
            assert node.competing(evaluations, limit)
            bounds.append(node.bound)
            assert node.priced == priced <= node.bound <= shortest * (1.0 + 1e-9)
    assert bounds == sorted(bounds) and node.incumbent.routes
    assert m == 1 or bounds[-1] > priced


def test_without_room_for_any_part_the_bound_stays():
    with Watch(60.0) as clock:
        node = _priced(generate(6, 60, 2, seed=6), clock)
        evaluations, priced = node.generation.evaluations(0, clock), node.priced
        assert node.competing(evaluations, node.limit, work=0.0) is None
        assert node.bound == node.priced == priced
