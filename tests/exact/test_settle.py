"""Settling: whatever the lower bounds, the choice among the true costs is found, and few of them are asked for."""

import itertools
import math

import numpy as np
import pytest

from mamttsp.exact import Parameters
from mamttsp.exact.fleet import Fleet
from mamttsp.exact.sets import to_words
from mamttsp.exact.settle import Sets, settle
from mamttsp.options import Watch

SEEDS = range(24)
UNIT = 100.0


def _words(sets):
    """Return sets of targets as the words of labels."""
    return to_words(np.array([[u in S for u in range(5)] for S in sets]))


def _random(seed):
    """Return (columns [(layer, set)], bounds, true costs, fleet): several columns of a set, and some sets without a
    route (infinite cost)."""
    rng = np.random.default_rng(seed)
    K, n = 1 + seed % 2, 5
    fleet = Fleet(rng.integers(1, 4, K), 1)
    every = [frozenset(S) for size in (1, 2, 3) for S in itertools.combinations(range(n), size)]
    keys = [(int(k), every[j]) for k in range(K) for j in rng.choice(len(every), 16, replace=False)]
    true = {key: math.inf if rng.random() < 0.1 else rng.uniform(10, 40) * len(key[1]) for key in keys}
    columns = [keys[j] for j in rng.integers(0, len(keys), 40)]
    bounds = np.array([min(true[key], 30.0 * len(key[1])) * rng.uniform(0.7, 1.0) for key in columns])
    return columns, bounds, true, fleet


def _best(columns, true, fleet):
    """Return the least true cost of a choice among the columns' sets, by brute force."""
    best = {frozenset(): 0.0}
    for k in np.repeat(np.arange(len(fleet.counts)), fleet.counts):
        longer = dict(best)
        for (done, cost), (layer, S) in itertools.product(best.items(), set(columns)):
            if layer == k and not done & S:
                longer[done | S] = min(longer.get(done | S, math.inf), cost + true[layer, S])
        best = longer
    return best.get(frozenset(range(5)), math.inf)


class _Run:
    """A settling; `asked` are the sets whose costs were asked for, `bounds` what was told."""

    def __init__(self, columns, bounds, true, fleet, limit):
        self.asked, self.bounds = [], []
        sets = Sets(_words(S for _, S in columns), np.array([k for k, _ in columns]), bounds, 5)

        def settle_set(own):
            (key,) = {columns[j] for j in own}
            self.asked.append(key)
            return true[key]

        with Watch(30.0) as clock:
            self.done, self.chosen = settle(
                sets, fleet, lambda: limit, UNIT, Parameters(), settle_set, self.bounds.append, clock
            )


@pytest.mark.parametrize("seed", SEEDS)
def test_the_bound_reaches_the_best_choice_or_the_limit(seed):
    columns, bounds, true, fleet = _random(seed)
    best = _best(columns, true, fleet)
    for limit in (1000.0, best * 1.05, best * 0.9) if math.isfinite(best) else (1000.0,):
        run = _Run(columns, bounds, true, fleet, limit)
        assert run.done and max(run.bounds) == pytest.approx(min(best, limit), rel=1e-6)
        assert all(bound <= min(best, limit) * (1 + 1e-9) for bound in run.bounds)
        assert len(run.asked) == len(set(run.asked))
        if best < limit:
            chosen = [columns[own[0]] for own in run.chosen]
            assert sorted(u for _, S in chosen for u in S) == list(range(5))
            assert sum(true[key] for key in chosen) == pytest.approx(best, rel=1e-6)


@pytest.mark.parametrize("seed", SEEDS)
def test_columns_of_one_set_and_layer_are_one(seed):
    columns, bounds, _, _ = _random(seed)
    sets = Sets(_words(S for _, S in columns), np.array([k for k, _ in columns]), bounds, 5)
    assert len(sets.cost) == len(set(columns))
    for j, own in enumerate(sets.columns):
        (key,) = {columns[x] for x in own}
        served = frozenset(np.flatnonzero(sets.members[:, [j]].toarray().ravel()).tolist())
        assert key == (sets.agents[j], served) and (sets.of_column[own] == j).all()
        assert sets.cost[j] == min(bounds[x] for x, other in enumerate(columns) if other == key)


def test_where_bounds_are_exact_little_is_asked():
    columns, _, true, fleet = _random(2)
    finite = [key for key in columns if math.isfinite(true[key])]
    run = _Run(finite, np.array([true[key] for key in finite]), true, fleet, 1000.0)
    assert run.done and len(run.asked) <= 5


def test_what_cannot_be_told_ends_it():
    columns, bounds, true, fleet = _random(0)
    assert not _Run(columns, bounds, dict.fromkeys(true), fleet, 1000.0).done
