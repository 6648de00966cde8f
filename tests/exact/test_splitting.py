"""Branching: the parts of a decision share out all solutions, and each part keeps to it."""

import itertools

import numpy as np
import pytest

from mamttsp import generate
from mamttsp.exact import Parameters, solve_exact
from mamttsp.exact.fleet import Fleet
from mamttsp.exact.splitting import Decision, decisions, fleets
from mamttsp.options import Options
from tests.exact.certificates import assert_brackets
from tests.exact.enumeration import optimum
from tests.exact.networks import alike, flyable_routes, network_of, pieces_at, random_times, small, unlike
from tests.exact.paths import NONE_FITS

GRAPHS = [small(seed) for seed in range(4)] + [unlike(seed) for seed in range(4)]


def _stops(graph, route):
    return [-1, *graph.tau[list(route)], -1]


def _said(graph, decision, route):
    """Whether a route of segments keeps to a decision, in plain words."""
    stops, layer = _stops(graph, route), graph.layer[route[0]]
    if decision.w < 0:
        return decision.u not in stops or (layer == decision.layer) == decision.holds
    follows = (decision.u, decision.w) in itertools.pairwise(stops)
    touched = decision.u in stops or decision.w in stops
    return (follows or not touched) if decision.holds else not follows


def _all_decisions(graph):
    n = graph.n_targets
    pairs = [(u, w, -1) for u, w in itertools.permutations(range(n), 2)]
    served = [(u, -1, k) for u in range(n) for k in range(graph.n_layers)]
    return [Decision(*key, holds) for key in pairs + served for holds in (True, False)]


@pytest.mark.parametrize("graph", GRAPHS)
def test_what_a_decision_permits(graph):
    for decision, route in itertools.product(_all_decisions(graph), flyable_routes(graph)):
        permitted = decision.permits(graph.tau[list(route)], graph.layer[route[0]])
        assert permitted == _said(graph, decision, route)


@pytest.mark.parametrize("graph", GRAPHS)
def test_a_network_keeps_permitted_routes_and_loses_others(graph):
    rng, network = np.random.default_rng(0), network_of(graph, 5.0)
    timed = [(r, t) for r in flyable_routes(graph) if (t := random_times(graph, r, rng)) is not None]
    for decision in _all_decisions(graph):
        part = decision.within(network)
        for route, times in timed:
            assert _flies(part, route, times) == _said(graph, decision, route)


def _flies(network, route, times):
    """Whether pieces at these times are joined by arcs of the network, from a start to an end."""
    at = [pieces_at(network.pieces, i, t) for i, t in zip(route, times)]
    arcs = set(zip(network.arcs.tail.tolist(), network.arcs.head.tolist()))
    reached = {q for q in at[0].tolist() if network.starts[q]}
    for here in at[1:]:
        reached = {r for q in reached for r in here.tolist() if (q, r) in arcs}
    return any(network.ends[q] for q in reached)


def test_the_decision_is_where_the_support_is_most_divided():
    support = [([0, 1, 2], 0.5, 0), ([0, 2, 1], 0.5, 0)]
    one, other = decisions(support, 0.01)
    assert one._replace(holds=False) == other and one.holds
    assert (one.u, one.w) in {(0, 1), (1, 2), (0, 2), (2, 1)}
    assert decisions([([0, 1, 2], 1.0, 0)], 0.01) == []


def test_the_layer_decides_where_orders_agree():
    one, other = decisions([([0, 1], 0.5, 0), ([0, 1], 0.5, 1)], 0.01)
    assert one.w == other.w == -1 and one.layer == other.layer and one.holds != other.holds


def test_fleets_are_below_and_above_a_fraction():
    support = [([0], 1.0, 0), ([1], 0.6, 0)]
    few, many = fleets(support, alike(5), 0.1)
    assert few.counts.tolist() == [1] and few.least == 1
    assert many.counts.tolist() == [5] and many.least == 2
    assert fleets([([0], 1.0, 0), ([1], 1.0, 0)], alike(5), 0.1) == []
    assert fleets(support, Fleet(np.array([2, 2]), 1), 0.1) == []


@pytest.mark.parametrize("seed", range(6))
def test_without_memory_for_shorter_pieces_nodes_are_split_until_their_routes_are_told(seed):
    """The latest node first; what is left in the end is the error of the first pieces."""
    problem, parameters = generate(5, 60, 2, seed=seed), Parameters(**NONE_FITS, most_arcs=1, pieces_each=12)
    solution = solve_exact(problem, Options(time_limit=60.0), parameters)
    assert_brackets(problem, solution, optimum(problem))
    assert solution.bound > 0.95 * solution.objective and solution.runtime < 60.0
