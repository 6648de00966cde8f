"""The fleet: how many routes there may and must be, and the least that they cost together."""

import itertools
import math

import numpy as np
import pytest

from mamttsp import Agents, build_graph, generate
from mamttsp.exact.fleet import Fleet


def _permitted(fleet):
    """Return all numbers of routes of each layer."""
    numbers = itertools.product(*(range(count + 1) for count in fleet.counts))
    return [number for number in numbers if sum(number) >= fleet.least]


@pytest.mark.parametrize("seed", range(20))
def test_total_and_rest_are_the_least_over_all_permitted_numbers(seed):
    rng = np.random.default_rng(seed)
    counts = rng.integers(1, 4, rng.integers(1, 4))
    fleet = Fleet(counts, int(rng.integers(1, counts.sum() + 2)))
    cheapest = rng.uniform(-10, 10, len(counts))
    assert fleet.total(cheapest) == pytest.approx(min((n @ cheapest for n in _permitted(fleet)), default=math.inf))
    for k, rest in enumerate(fleet.rest(cheapest)):
        with_it = [n @ cheapest - cheapest[k] for n in _permitted(fleet) if n[k]]
        assert rest == pytest.approx(min(with_it, default=math.inf))


@pytest.mark.parametrize("capacities, needed", [((None, None), 1), ((6.0, None), 1), ((5.0, 4.0), 2), ((2.0, 3.0), 4)])
def test_as_many_routes_are_needed_as_capacities_ask_for(capacities, needed):
    agents = [Agents(1, (0, 0), 4.0, capacity=capacities[0]), Agents(2, (9, 0), 4.0, capacity=capacities[1])]
    fleet = Fleet.of(build_graph(generate(9, 40, agents=agents, demands=1.0)))
    assert fleet.counts.tolist() == [1, 2] and fleet.least == needed  # 4, of three: no solution


def test_what_nobody_can_fly_costs_without_end_only_where_it_is_needed():
    assert Fleet(np.array([1, 1]), 1).total(np.array([np.inf, 2.0])) == 2.0
    assert Fleet(np.array([1, 1]), 2).total(np.array([np.inf, 2.0])) == np.inf
    assert Fleet(np.array([1, 1]), 1).rest(np.array([np.inf, -2.0])).tolist() == [-2.0, 0.0]
