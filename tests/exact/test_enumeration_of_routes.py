"""Labels: whatever route a solution within the limit may use is among the columns, and every column can be flown."""

import numpy as np
import pytest

from mamttsp.exact import ngsets
from mamttsp.exact.enumeration import Enumeration
from mamttsp.exact.evaluation import evaluate
from mamttsp.exact.sets import members
from mamttsp.timing import best_times
from tests.exact.networks import (
    best_solution,
    flyable_routes,
    in_full,
    network_of,
    pays,
    random_cuts,
    random_sets,
    small,
)

CASES = [(seed, m) for seed in range(6) for m in (1, 2)]


def _enumeration(evaluation, slack, whole=False, most=np.inf, budget=np.inf):
    return Enumeration(evaluation, slack, len(evaluation.pi), whole, most, budget, lambda: False)


def _evaluation(seed, n_agents, cuts=3):
    rng, graph = np.random.default_rng(seed), small(seed)
    n = graph.n_targets
    length, routes = best_solution(graph, n_agents)
    pi = rng.uniform(0.6, 1.4, n) * length / n
    N = ngsets.as_words(random_sets(rng, n))
    return graph, length, routes, evaluate(network_of(graph, 6.0), N, pi, random_cuts(rng, n, cuts), n_agents, 0.0)


def _cost_by_set(found):
    cost = {}
    for visited, value in zip(found.visited, found.cost):
        served = frozenset(members(visited))
        cost[served] = min(cost.get(served, np.inf), value)
    return cost


@pytest.mark.parametrize("seed, n_agents", CASES)
def test_the_sets_of_an_optimal_solution_are_columns_at_no_more_than_their_lengths(seed, n_agents):
    graph, length, routes, evaluation = _evaluation(seed, n_agents)
    cost = _cost_by_set(_enumeration(evaluation, evaluation.slack(length * (1 + 1e-7))))
    for route in routes:
        assert cost[frozenset(graph.tau[list(route)].tolist())] <= best_times(graph, list(route))[0] * (1 + 1e-7)


@pytest.mark.parametrize("seed, n_agents", CASES)
def test_every_route_within_the_slack_is_a_sequence_of_its_set(seed, n_agents):
    graph, length, _, evaluation = _evaluation(seed, n_agents)
    slack = evaluation.slack(length * (1 + 1e-7))
    found = _enumeration(evaluation, slack)
    found.lead(np.ones(len(found.cost), dtype=bool))
    cost, columns, inside = _cost_by_set(found), {}, 0
    for column, visited in enumerate(found.visited):
        columns.setdefault(frozenset(members(visited)), []).append(column)
    sequences = {served: set(found.sequences(np.array(own), 10**6)) for served, own in columns.items()}
    for route in flyable_routes(graph):
        tau = graph.tau[list(route)].tolist()
        shortest = best_times(graph, list(route))[0]
        reduced = shortest - evaluation.pi[tau].sum() + pays(tau, in_full(evaluation.cuts))
        if reduced <= slack - 1e-6:
            inside += 1
            assert cost[frozenset(tau)] <= shortest + 1e-6
            assert route in sequences[frozenset(tau)]
    assert inside >= 1


@pytest.mark.parametrize("seed, n_agents", CASES)
def test_every_column_can_be_flown(seed, n_agents):
    graph, _, _, evaluation = _evaluation(seed, n_agents)
    found, flyable = _enumeration(evaluation, 1e9), set(flyable_routes(graph))
    assert len(found.cost) and all(found.segments(column) in flyable for column in range(len(found.cost)))
    assert {frozenset(graph.tau[list(route)].tolist()) for route in flyable} == _cost_by_set(found).keys()


@pytest.mark.parametrize("seed", range(4))
def test_for_one_agent_only_routes_through_all_targets_are_columns(seed):
    graph, length, _, evaluation = _evaluation(seed, 1, cuts=0)
    found = _enumeration(evaluation, evaluation.slack(length * (1 + 1e-7)), whole=True)
    assert set(_cost_by_set(found)) == {frozenset(range(graph.n_targets))}


def test_what_needs_too_many_extensions_is_told():
    _, _, _, evaluation = _evaluation(0, 1)
    full = _enumeration(evaluation, 1e9)
    assert full.complete and full.size > 100
    assert not _enumeration(evaluation, 1e9, budget=full.size // 2).complete


def test_what_needs_too_many_labels_is_told():
    _, _, _, evaluation = _evaluation(0, 1)
    assert not _enumeration(evaluation, 1e9, most=_enumeration(evaluation, 1e9).size // 2).complete
