"""Subset-row cuts: counted as they are meant, found where they are violated, and never a bound above the optimum."""

import itertools

import numpy as np
import pytest

from mamttsp import build_graph, generate
from mamttsp.exact.cuts import Cuts, separate
from mamttsp.exact.evaluation import evaluate
from tests.exact.enumeration import optimum
from tests.exact.networks import alike, network_of, pays, random_cuts, random_sets, small

SEEDS = range(8)


@pytest.mark.parametrize("seed", SEEDS)
def test_routes_pay_by_a_plain_count(seed):
    rng = np.random.default_rng(seed)
    cuts = random_cuts(rng, 7, 4)
    routes = [rng.integers(0, 7, rng.integers(1, 12)) for _ in range(50)]
    paid = cuts.paid(routes)
    assert paid.shape == (50, 4) and paid.any()
    assert -paid @ cuts.sigma == pytest.approx([pays(route, cuts) for route in routes])


@pytest.mark.parametrize("seed", SEEDS)
def test_sets_pay_as_often_as_half_their_visits(seed):
    rng = np.random.default_rng(seed)
    cuts, members = random_cuts(rng, 7, 4), rng.random((7, 30)) < 0.5
    expected = [sum(s * (row[own].sum() // 2) for row, s in zip(cuts.rows, cuts.sigma)) for own in members.T]
    assert cuts.price_of(members.astype(float)) == pytest.approx(np.array(expected))


@pytest.mark.parametrize("seed, n_agents", list(itertools.product(SEEDS, (1, 2, 3))))
def test_no_price_lifts_the_bound_above_the_optimum(seed, n_agents):
    rng, instance = np.random.default_rng(seed), generate(5, 40, n_agents, seed=seed)
    network, best = network_of(build_graph(instance), 8.0), optimum(instance)
    for _ in range(6):
        pi, cuts = best / 5 * rng.uniform(0.3, 1.7, 5), random_cuts(rng, 5, 4)
        bound = evaluate(network, random_sets(rng, 5), pi, cuts, alike(n_agents), 0.0).bound
        assert bound <= best * (1 + 1e-9)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_cuts_found_are_those_that_are_violated_most(seed):
    rng, n = np.random.default_rng(seed), 6
    routes = [rng.permutation(n)[: rng.integers(2, 5)] for _ in range(6)]
    level = rng.uniform(0.2, 0.8, 6)
    rows, memory = separate(routes, level, n, 5, 0.02)
    violation = {
        triple: sum(share * (np.isin(route, triple).sum() // 2) for route, share in zip(routes, level))
        for triple in itertools.combinations(range(n), 3)
    }
    worst = sorted((value for value in violation.values() if value > 1.02), reverse=True)[:5]
    assert [violation[tuple(np.flatnonzero(row))] for row in rows] == pytest.approx(worst)
    paid = Cuts(rows, memory, np.full(len(rows), -1.0)).paid(routes)
    assert level @ paid == pytest.approx(worst)  # the memories are large enough


@pytest.mark.parametrize("seed", SEEDS)
def test_a_columns_length_does_not_depend_on_prices_of_cuts(seed):
    """Prices of cuts are constants within a route: they change no slope of the values along it, so no length."""
    rng, graph = np.random.default_rng(seed), small(seed, n=5)
    network, N, pi = network_of(graph, 8.0), np.ones((5, 5), bool), rng.uniform(20, 60, 5)
    lengths = []
    for cuts in (random_cuts(rng, 5, 4), Cuts.none(5)):
        evaluation = evaluate(network, N, pi, cuts, alike(1), 0.0)
        lengths.append(dict(zip(*_lengths(evaluation))))
    both = lengths[0].keys() & lengths[1].keys()
    assert both and all(lengths[0][route] == pytest.approx(lengths[1][route]) for route in both)


def _lengths(evaluation):
    routes, _ = evaluation.columns(1000, 1000, 15)
    return [tuple(route.tolist()) for route in routes], [evaluation.length(route) for route in routes]
