"""Labels: whatever route a solution within the limit may use is among the columns, and every column can be flown."""

import itertools

import numpy as np
import pytest

from mamttsp import build_graph, generate, solve
from mamttsp.exact import Parameters, labels
from mamttsp.exact.column_generation import ColumnGeneration
from mamttsp.exact.cuts import Cuts
from mamttsp.exact.enumeration import Enumeration
from mamttsp.exact.evaluation import evaluate, restricted
from mamttsp.exact.fleet import Fleet
from mamttsp.exact.sets import to_marks
from mamttsp.options import Watch
from mamttsp.timing import best_times
from tests.exact.networks import (
    alike,
    assert_flown,
    best_solution,
    flyable_routes,
    in_full,
    network_of,
    pays,
    random_cuts,
    random_sets,
    small,
    unlike,
)

#: (seed, agents), and seeds of instances with two types of agents; labels are grown at 1 + seed % 3 prices
CASES = [(seed, m) for seed in range(6) for m in (1, 2)] + [(seed, None) for seed in range(6)]

NO_LIMIT = 1e9


def _enumeration(evaluations, limit, whole=False, longest=1, most=np.inf, budget=np.inf):
    return Enumeration(evaluations, limit, whole, longest, most, budget, Watch())


def _evaluations(seed, n_agents, cuts=3):
    rng, graph = np.random.default_rng(seed), unlike(seed) if n_agents is None else small(seed)
    n, fleet = graph.n_targets, Fleet.of(graph) if n_agents is None else alike(n_agents)
    length, routes = best_solution(graph, fleet)
    pis = rng.uniform(0.6, 1.4, (1 + seed % 3, n)) * length / n
    N, network, cuts = random_sets(rng, n), network_of(graph, 6.0), random_cuts(rng, n, cuts)
    return graph, length, routes, [evaluate(network, N, pi, cuts, fleet, 0.0) for pi in pis]


def _cost_by_set(found):
    """Return {(layer, set of targets): least cost}."""
    cost = {}
    for key, value in zip(_keys(found), found.cost):
        cost[key] = min(cost.get(key, np.inf), value)
    return cost


def _keys(found):
    served = to_marks(found.visited, found.n)
    return [(int(k), frozenset(np.flatnonzero(marks))) for k, marks in zip(found.agents, served)]


def _key(graph, route):
    return int(graph.layer[route[0]]), frozenset(graph.tau[list(route)].tolist())


@pytest.mark.parametrize("seed, n_agents", CASES)
def test_the_sets_of_an_optimal_solution_are_columns_at_no_more_than_their_lengths(seed, n_agents):
    graph, length, routes, evaluations = _evaluations(seed, n_agents)
    cost = _cost_by_set(_enumeration(evaluations, length * (1 + 1e-7)))
    for route in routes:
        assert cost[_key(graph, route)] <= best_times(graph, list(route))[0] * (1 + 1e-7)


@pytest.mark.parametrize("seed, n_agents", CASES)
def test_every_route_within_the_slack_is_a_sequence_of_its_set(seed, n_agents):
    graph, length, _, evaluations = _evaluations(seed, n_agents)
    limit = length * (1 + 1e-7)
    found = _enumeration(evaluations, limit)
    found.lead(np.ones(len(found.cost), dtype=bool))
    cost, columns, inside = _cost_by_set(found), {}, 0
    for column, key in enumerate(_keys(found)):
        columns.setdefault(key, []).append(column)
    sequences = {served: set(found.sequences(np.array(own), 10**6)) for served, own in columns.items()}
    for route in flyable_routes(graph):
        tau = graph.tau[list(route)].tolist()
        shortest = best_times(graph, list(route))[0]
        cheap = shortest + pays(tau, in_full(evaluations[0].cuts)) + 1e-6
        if all(cheap - e.pi[tau].sum() <= e.slack(limit)[graph.layer[route[0]]] for e in evaluations):
            inside += 1
            assert cost[_key(graph, route)] <= shortest + 1e-6
            assert route in sequences[_key(graph, route)]
    assert inside >= 1


@pytest.mark.parametrize("seed, n_agents", CASES)
def test_the_arcs_of_what_is_left_hold_an_optimal_solution(seed, n_agents):
    graph, length, routes, evaluations = _evaluations(seed, n_agents)
    network, found = evaluations[0].network, _enumeration(evaluations, length * (1 + 1e-7))
    found.lead(np.ones(len(found.cost), dtype=bool))
    left = restricted(network, found.used_arcs(network.arcs), *found.used_ends())
    assert_flown(left, graph, routes)
    assert len(left.arcs.head) < len(network.arcs.head)


@pytest.mark.parametrize("seed", range(5))
def test_links_to_dominated_labels_are_handed_on_to_the_last_heir(seed):
    rng, count = np.random.default_rng(seed), 200
    heir = np.array([rng.integers(y + 1, count) if y + 1 < count and rng.random() < 0.8 else -1 for y in range(count)])
    links = rng.integers(0, count, (500, 2)).astype(np.int32)
    stay, expected = np.flatnonzero(heir < 0).tolist(), []
    for x, y in links.tolist():
        while heir[y] >= 0:
            y = heir[y]
        expected.append([x, stay.index(y)])
    labels._hand_on(links, heir.astype(np.int32), count)
    assert links.tolist() == expected


def test_of_very_many_labels_none_is_lost():
    """More labels of one number of visits than there is room for at first: arrays and the table of chains grow."""
    graph = build_graph(generate(5, 60, seed=2))
    network, N = network_of(graph, 0.4), np.ones((5, 5), dtype=bool)
    found = _enumeration([evaluate(network, N, np.zeros(5), Cuts.none(5), alike(1), 0.0)], NO_LIMIT)
    assert max(len(layer.left) for layer in found.layers) > 2**12
    cost, flyable = _cost_by_set(found), flyable_routes(graph)
    assert {_key(graph, route) for route in flyable} == cost.keys()
    shortest = {}
    for route in flyable:
        shortest.setdefault(_key(graph, route), []).append(route)
    for key in list(shortest)[::7]:
        least = min(best_times(graph, list(route))[0] for route in shortest[key])
        assert 0.9 * least <= cost[key] <= least * (1 + 1e-7)


@pytest.mark.parametrize("seed, n_agents", CASES)
def test_every_column_can_be_flown(seed, n_agents):
    graph, _, _, evaluations = _evaluations(seed, n_agents)
    found, flyable = _enumeration(evaluations, NO_LIMIT), set(flyable_routes(graph))
    assert len(found.cost) and all(found.segments(column) in flyable for column in range(len(found.cost)))
    assert {_key(graph, route) for route in flyable} == _cost_by_set(found).keys()


@pytest.mark.parametrize("seed", range(4))
def test_for_one_agent_only_routes_through_all_targets_are_columns(seed):
    graph, length, _, evaluations = _evaluations(seed, 1, cuts=0)
    found = _enumeration(evaluations, length * (1 + 1e-7), whole=True)
    assert set(_cost_by_set(found)) == {(0, frozenset(range(graph.n_targets)))}


def test_what_needs_too_many_extensions_is_told():
    _, _, _, evaluations = _evaluations(0, 1)
    full = _enumeration(evaluations, NO_LIMIT)
    assert full.complete and full.size > 100
    assert not _enumeration(evaluations, NO_LIMIT, budget=full.size // 2).complete


def test_what_needs_too_many_labels_is_told():
    _, _, _, evaluations = _evaluations(0, 1)
    assert not _enumeration(evaluations, NO_LIMIT, most=_enumeration(evaluations, NO_LIMIT).size // 2).complete


@pytest.mark.parametrize("whole", [True, False])
def test_what_will_not_last_ends_early(whole):
    """More than the budget's share of the first half is gone after half of the visits of a long route; or the next
    visit alone takes more than is left of it."""
    graph, _, _, evaluations = _evaluations(0, 1, cuts=0)
    full = _enumeration(evaluations, NO_LIMIT, whole, graph.n_targets)
    outgoing = np.diff(evaluations[0].arcs.start)
    extensions = [int(outgoing[layer.piece].sum()) for layer in full.layers]
    assert full.complete and extensions[-1] < extensions[2] > extensions[0]
    early = _enumeration(evaluations, NO_LIMIT, whole, graph.n_targets, budget=sum(extensions))
    assert not early.complete and len(early.layers) < len(full.layers) - 1
    assert _enumeration(evaluations, NO_LIMIT, whole, budget=sum(extensions)).complete
    one_short = _enumeration(evaluations, NO_LIMIT, whole, budget=sum(extensions[:3]) - 1)
    assert not one_short.complete and len(one_short.layers) == 3


@pytest.mark.parametrize("seed", range(3))
def test_other_prices_leave_fewer_labels_and_the_optimum(seed):
    """Ten targets, one agent, prices that column generation tries with three entries of a piece, and others."""
    instance = generate(10, 60, seed=seed)
    graph, known = build_graph(instance), solve(instance, method="exact").objective
    generation = ColumnGeneration(
        network_of(graph, 6.0), 10, alike(1), np.full(10, known / 10), Parameters(), graph.size
    )  # fmt: skip
    limit = known * (1 + 1e-7)
    generation.run(3, limit, Watch(), lambda bound: None)
    evaluations = generation.evaluations(12, Watch())
    one, many = (_enumeration(own, limit, whole=True) for own in (evaluations[:1], evaluations))
    assert many.size < 0.8 * one.size and len(many.cost)
    assert many.cost.min() == pytest.approx(one.cost.min(), rel=1e-9) and many.cost.min() <= limit


@pytest.mark.parametrize("seed, n_agents", CASES[:8])
def test_labels_are_the_same_however_often_the_clock_is_looked_at(monkeypatch, seed, n_agents):
    _, length, _, evaluations = _evaluations(seed, n_agents)
    at_once = _enumeration(evaluations, length * 1.2)
    monkeypatch.setattr(labels, "_AT_ONCE", 7)
    in_parts = _enumeration(evaluations, length * 1.2)
    for one, other in zip(at_once.layers, in_parts.layers, strict=True):
        assert all(np.array_equal(part, same) for part, same in zip(one, other))
    assert all(np.array_equal(one, other) for one, other in zip(at_once.links, in_parts.links, strict=True))
    assert np.array_equal(at_once.cost, in_parts.cost) and len(at_once.cost)


def test_labels_end_in_the_middle_of_a_visit_when_time_is_up(monkeypatch):
    _, _, _, evaluations = _evaluations(0, 2)
    monkeypatch.setattr(labels, "_AT_ONCE", 7)
    asked = itertools.count()
    monkeypatch.setattr(Watch, "out", lambda _: next(asked) >= 3)
    assert not _enumeration(evaluations, NO_LIMIT).complete and next(asked) == 4
