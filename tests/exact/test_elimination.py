"""Elimination by reduced cost: what an optimal solution flies along is never dropped, much else is."""

import itertools

import numpy as np
import pytest

from mamttsp.exact.column_generation import ColumnGeneration
from mamttsp.exact.evaluation import evaluate, refined
from mamttsp.exact.fleet import Fleet
from mamttsp.exact.parameters import Parameters
from mamttsp.options import Watch
from mamttsp.timing import best_times
from tests.exact.networks import (
    alike,
    assert_flown,
    best_solution,
    network_of,
    random_cuts,
    random_sets,
    small,
    unlike,
)

CASES = [(seed, small(seed), alike(m)) for seed in range(6) for m in (1, 2, 3)]
CASES += [(seed, graph, Fleet.of(graph)) for seed, graph in enumerate(map(unlike, range(6)))]
every_case = pytest.mark.parametrize(
    "seed, graph, fleet", CASES, ids=[f"{seed}-{fleet.counts}" for seed, _, fleet in CASES]
)


@every_case
def test_at_any_prices_an_optimal_solution_stays(seed, graph, fleet):
    rng = np.random.default_rng(seed)
    length, routes = best_solution(graph, fleet)
    network, n = network_of(graph, 6.0), graph.n_targets
    for share in (0.2, 0.6, 1.0):
        pi = rng.uniform(1 - share, 1 + share, n) * length / n
        cuts, N = random_cuts(rng, n, 2), random_sets(rng, n)
        evaluation = evaluate(network, N, pi, cuts, fleet, 0.0)
        assert_flown(evaluation.eliminated(length * (1 + 1e-7), 0.0), graph, routes)


@every_case
def test_at_good_prices_little_else_stays(seed, graph, fleet):
    length, routes = best_solution(graph, fleet)
    network, n = network_of(graph, 3.0), graph.n_targets
    generation = ColumnGeneration(network, n, fleet, np.full(n, length / n), Parameters(), graph.size)
    with Watch() as clock:
        generation.run(None, length, clock, lambda bound: None)
    left = generation.best.eliminated(length * (1 + 1e-7), generation.tolerance)
    assert_flown(left, graph, routes)
    assert len(left.arcs.head) < 0.3 * len(network.arcs.head)


@every_case
def test_shorter_pieces_of_what_is_left_hold_it_as_well(seed, graph, fleet):
    rng = np.random.default_rng(seed)
    length, routes = best_solution(graph, fleet)
    network, n = network_of(graph, 9.0), graph.n_targets
    times = {i: t for route in routes for i, t in zip(route, best_times(graph, list(route))[1])}
    for width in (4.0, 1.5):
        pi, N = rng.uniform(0.6, 1.4, n) * length / n, random_sets(rng, n)
        evaluation = evaluate(network, N, pi, random_cuts(rng, n, 1), fleet, 0.0)
        left = evaluation.eliminated(length * (1 + 1e-7), 0.0)
        network = refined(left, graph, width, times, range(n))
        assert_flown(network, graph, routes)
        assert (network.pieces.b - network.pieces.a).max() <= 1.6 * width


@every_case
def test_elimination_round_after_round_keeps_it(seed, graph, fleet):
    """What the first prices drop is missing from the evaluation at the second ones, and still nothing is lost."""
    rng = np.random.default_rng(seed)
    length, routes = best_solution(graph, fleet)
    network, n = network_of(graph, 6.0), graph.n_targets
    sizes = [len(network.arcs.head)]
    for _ in range(4):
        pi = rng.uniform(0.5, 1.5, n) * length / n
        evaluation = evaluate(network, random_sets(rng, n), pi, random_cuts(rng, n, 1), fleet, 0.0)
        network = evaluation.eliminated(length * (1 + 1e-7), 0.0)
        assert_flown(network, graph, routes)
        sizes.append(len(network.arcs.head))
    assert all(after <= before for before, after in itertools.pairwise(sizes)) and sizes[-1] < sizes[0]
