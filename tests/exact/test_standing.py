"""Standing and incumbent: bounds are capped at the limit, and only tours that can be flown count."""

import itertools
import math

import numpy as np
import pytest

from mamttsp import build_graph, check, generate
from mamttsp.exact.fleet import Fleet
from mamttsp.exact.incumbent import Incumbent
from mamttsp.exact.standing import Standing
from mamttsp.timing import best_times
from tests.exact.networks import alike, best_solution, flyable_routes, small, unlike


@pytest.fixture
def found():
    """Return (Standing at a gap of 1 %, the optimum) with the tours of a best solution."""
    graph = small(1)
    length, routes = best_solution(graph, alike(2))
    standing = Standing(graph, alike(2), 0.01)
    assert standing.incumbent.offer(routes)
    return standing, length


def test_no_bound_passes_the_limit_and_none_falls(found):
    standing, length = found
    assert 0.99 * length < standing.limit < length
    for bound, expected in ((0.5 * length, 0.5), (0.3 * length, 0.5), (-math.inf, 0.5), (0.9 * length, 0.9)):
        standing.raise_bound(bound)
        assert standing.bound == pytest.approx(expected * length) and not standing.closed()
    for bound in (1.5 * length, math.inf):  # over a network that lacks what lies above the limit
        standing.raise_bound(bound)
        assert standing.bound == standing.limit and standing.closed() and not standing.infeasible


def test_a_bound_is_lowered_by_what_sums_may_be_wrong(found):
    standing, length = found
    standing.raise_bound(0.8 * length)
    assert 0.8 * length * (1 - 1e-8) < standing.bound < 0.8 * length


def test_without_tours_a_bound_that_no_solution_can_reach_proves_that_there_is_none():
    graph = small(1)
    standing = Standing(graph, alike(2), 1e-4)
    most = 2 * graph.speeds[0] * graph.horizon
    standing.raise_bound(0.999 * most)
    assert not standing.infeasible and standing.figures()[0] is None
    standing.raise_bound(math.inf)
    assert standing.infeasible


def test_tours_are_taken_if_they_can_be_flown_and_are_shorter():
    problem = generate(4, 40, 2, seed=1)
    graph = build_graph(problem)
    length, best = best_solution(graph, alike(2))
    flyable = set(flyable_routes(graph))
    whole = [r for r in itertools.permutations(graph.V_seg, 4) if len(set(graph.tau[list(r)])) == 4]
    longer = [r for r in whole if r in flyable and best_times(graph, list(r))[0] > 1.01 * length]
    late = next(r for r in whole if r not in flyable)
    incumbent = Incumbent(graph, alike(2))
    assert not incumbent.offer([late]) and incumbent.routes == () and incumbent.timed(late) is None
    assert incumbent.offer([longer[0]]) and not incumbent.offer([longer[0]]) and incumbent.offer(best)
    assert not incumbent.offer([longer[0]]) and incumbent.objective == pytest.approx(length)
    assert check(problem, incumbent.tours()) == pytest.approx(length)
    tours = incumbent.tours()
    assert [incumbent.visit_times()[i] for route in best for i in route] == [v.time for t in tours for v in t.visits]


CASES = [(seed, small(seed), alike(m)) for seed in range(4) for m in (1, 2, 3)]
CASES += [(seed, graph, Fleet.of(graph)) for seed, graph in enumerate(map(unlike, range(6)))]


@pytest.mark.parametrize("seed, graph, fleet", CASES, ids=[f"{seed}-{fleet.counts}" for seed, _, fleet in CASES])
def test_the_best_of_all_routes_timed_is_chosen(seed, graph, fleet):
    incumbent = Incumbent(graph, fleet)
    for route in flyable_routes(graph):
        incumbent.timed(route)
    incumbent.recombine(10.0)
    length, _ = best_solution(graph, fleet)
    assert incumbent.objective == (pytest.approx(length) if math.isfinite(length) else math.inf)
    assert (
        np.bincount([graph.layer[r[0]] for r in incumbent.routes], minlength=len(fleet.counts)) <= fleet.counts
    ).all()
