"""A node's bound from some of the routes, those of solutions in a lower part of the gap; and from smaller ng-sets,
where values to go take too many entries."""

import dataclasses

import pytest

from mamttsp import generate
from mamttsp.exact import solve_exact
from mamttsp.exact.fleet import Fleet
from mamttsp.exact.parameters import Parameters
from mamttsp.exact.ruin_and_recreate import Annealing
from mamttsp.exact.search import Search
from mamttsp.graph import build_graph
from mamttsp.options import Options, Watch
from tests.exact.certificates import assert_brackets
from tests.exact.enumeration import optimum

#: few pieces, and work enough for every enumeration
PARAMETERS = Parameters(piece=9.0, pieces_each=2, enumeration=1e6, enumeration_alone=1e6, prices=0)


def _root(instance, clock, parameters=PARAMETERS):
    """Return the Node of all solutions, before there are any tours."""
    graph = build_graph(instance)
    fleet, n = Fleet.of(graph), graph.n_targets
    search = Search(graph, fleet, 1e-4, clock, parameters, Annealing(graph, range(n), fleet, parameters))
    node = search.root()
    search.nodes = [node]
    return node


def _priced(instance, clock):
    """Return (that Node, its prices moved; the Evaluations at these)."""
    node = _root(instance, clock)
    node.generation.run(None, node.limit, clock, node.raise_priced)
    return node, node.generation.evaluations(0, clock)


@pytest.mark.parametrize("m", [1, 2])
@pytest.mark.parametrize("seed", range(5))
def test_routes_of_a_lower_part_of_the_gap_raise_the_bound_but_never_above_the_optimum(seed, m):
    instance = generate(5, 40, m, seed=seed)
    shortest = optimum(instance)
    with Watch(60.0) as clock:
        node, evaluations = _priced(instance, clock)
        priced, bounds = node.priced, []
        for part in (0.02, 0.1, 0.5, 0.98):
            limit = priced + part * (node.limit - priced)
            assert node.competing(evaluations, limit)
            bounds.append(node.bound)
            assert node.priced == priced <= node.bound <= shortest * (1.0 + 1e-9)
    assert bounds == sorted(bounds) and node.incumbent.routes
    assert m == 1 or bounds[-1] > priced


@pytest.mark.parametrize("m", [1, 2])
@pytest.mark.parametrize("seed", range(5))
def test_a_lower_part_is_settled_to_its_end_or_to_the_optimum(seed, m):
    instance = generate(5, 40, m, seed=seed)
    shortest = optimum(instance)
    with Watch(60.0) as clock:
        node, evaluations = _priced(instance, clock)
        limits = [node.priced + part * (shortest - node.priced) for part in (0.1, 0.5, 1.5)]
        for limit in limits:
            routes, sets = node.competing(evaluations, limit)
            none_left = node.bound >= limit or not len(sets.cost)
            assert none_left or node.settle(sets, routes, limit)
            assert node.bound <= shortest * (1.0 + 1e-9)
            assert none_left or node.bound == pytest.approx(min(limit, shortest), rel=2e-4)
    assert node.incumbent.objective == pytest.approx(shortest, rel=1e-6)


def test_without_room_for_any_part_the_bound_stays():
    with Watch(60.0) as clock:
        node, evaluations = _priced(generate(6, 60, 2, seed=6), clock)
        priced = node.priced
        assert node.competing(evaluations, node.limit, work=0.0) is None
        assert node.bound == node.priced == priced


def test_where_values_take_too_many_entries_ng_sets_are_rolled_back():
    instance, parameters = generate(6, 60, 2, seed=6), dataclasses.replace(PARAMETERS, most_entries=12)
    with Watch(60.0) as clock:
        node = _root(instance, clock, parameters)
        before = node.generation.N
        assert node.round() == [node] and node.generation.rolled_back
        after = node.generation.N
        assert (before | ~after).all() and 0 < after.sum() < before.sum()
        node.round()
        assert (after == node.generation.N).all() and not len(node.generation.cuts.rows)
    assert 0.0 < node.bound <= optimum(instance) * (1.0 + 1e-9)


def test_where_they_always_do_nothing_is_proved():
    problem = generate(5, 60, 2, seed=0)
    solution = solve_exact(problem, Options(time_limit=60.0), Parameters(most_entries=1))
    assert_brackets(problem, solution, optimum(problem))
    assert solution.status == "feasible" and solution.bound == 0.0
