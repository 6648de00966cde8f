"""Set partitioning by HiGHS against brute force."""

import itertools
import math

import numpy as np
import pytest
from scipy import sparse

from mamttsp.exact import Parameters
from mamttsp.exact.fleet import Fleet
from mamttsp.exact.partition import choose, relax_choice
from tests.exact.networks import alike

SEEDS = range(16)
UNIT = 100.0


def _random(seed):
    """Return (members (n, J) bool, agents (J,), cost (J,), fleet): of one layer, and of two where the seed is odd."""
    rng = np.random.default_rng(seed)
    members = rng.random((5, 14)) < 0.45
    members = np.unique(members[:, members.any(axis=0)], axis=1)
    J, K = members.shape[1], 1 + seed % 2
    cost, counts, agents = rng.uniform(10, 60, J), rng.integers(1, 4, K), rng.integers(0, K, J)
    return members, agents, cost, Fleet(counts, 1 + int(seed % 4 == 3))


def _best(members, agents, cost, fleet, must=None):
    """Return (least cost, columns) of columns that the fleet permits and hold each target once, `must` among them."""
    best = math.inf, ()
    for size in range(fleet.least, fleet.n_agents + 1):
        for chosen in itertools.combinations(range(len(cost)), size):
            if (np.bincount(agents[list(chosen)], minlength=len(fleet.counts)) > fleet.counts).any():
                continue
            if (members[:, chosen].sum(axis=1) == 1).all() and (must is None or must in chosen):
                best = min(best, (cost[list(chosen)].sum(), chosen))
    return best


def _sparse(members):
    return sparse.csc_matrix(members.astype(float))


@pytest.mark.parametrize("seed", SEEDS)
def test_the_choice_is_the_best_one(seed):
    members, agents, cost, fleet = _random(seed)
    best, chosen = _best(members, agents, cost, fleet)
    limit = 200.0
    bound, found = choose(_sparse(members), agents, cost, fleet, limit, UNIT)
    assert bound <= min(best, limit) + 1e-9 and bound == pytest.approx(min(best, limit), abs=1e-4)
    assert (found is None) == (not chosen) and (found is None or sorted(found) == sorted(chosen))


@pytest.mark.parametrize("seed", SEEDS)
def test_a_choice_above_the_limit_is_none(seed):
    members, agents, cost, fleet = _random(seed)
    best, _ = _best(members, agents, cost, fleet)
    limit = min(best, 150.0) * 0.9
    bound, found = choose(_sparse(members), agents, cost, fleet, limit, UNIT)
    assert bound == pytest.approx(limit, abs=1e-4)
    assert found is None or cost[found].sum() >= limit


@pytest.mark.parametrize("seed", SEEDS)
def test_the_relaxation_is_below_and_its_slacks_drop_nothing_that_counts(seed):
    members, agents, cost, fleet = _random(seed)
    best, _ = _best(members, agents, cost, fleet)
    limit = 1.2 * min(best, 150.0)
    relaxed = relax_choice(_sparse(members), agents, cost, fleet, limit, UNIT, Parameters())
    assert relaxed.bound <= best + 1e-6
    for j in range(len(cost)):
        with_it = _best(members, agents, cost, fleet, must=j)[0]
        assert limit - with_it <= relaxed.slack[j] + 1e-6


def test_without_columns_there_is_no_choice():
    assert choose(sparse.csc_matrix((3, 0)), np.zeros(0, int), np.zeros(0), alike(2), 50.0, UNIT) == (50.0, None)


def test_costs_far_from_one_are_chosen_as_well():
    members = np.eye(3, dtype=bool)
    for scale in (1e-6, 1e9):
        bound, found = choose(_sparse(members), np.zeros(3, int), scale * np.ones(3), alike(3), 10 * scale, scale)
        assert bound == pytest.approx(3 * scale) and sorted(found) == [0, 1, 2]


def test_costs_far_below_the_unit_are_bounded_as_closely():
    bound, found = choose(_sparse(np.eye(3, dtype=bool)), np.zeros(3, int), np.full(3, 1e-5), alike(3), 1e-4, UNIT)
    assert sorted(found) == [0, 1, 2] and 3e-5 * (1 - 1e-5) <= bound <= 3e-5
