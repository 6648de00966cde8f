"""The restricted master against the same linear program, written down whole."""

import numpy as np
import pytest
from scipy.optimize import linprog

from mamttsp.exact.fleet import Fleet
from mamttsp.exact.restricted_master import _NEEDED, RestrictedMaster

SEEDS = range(12)
UNIT = 50.0


def _random(seed):
    """Return (fleet, visits (J, n), agents (J,), lengths (J,), paid (J, C)): some targets are visited twice."""
    rng = np.random.default_rng(seed)
    n, J, C, K = 6, 25, seed % 3, 1 + seed % 2
    fleet = Fleet(rng.integers(1, 4, K), 1 + int(seed % 4 == 1))
    visits = rng.choice([0.0, 1.0, 2.0], (J, n), p=[0.6, 0.35, 0.05])
    visits[~visits.any(axis=1), 0] = 1.0
    return fleet, visits, rng.integers(0, K, J), rng.uniform(10, 100, J), rng.integers(0, 2, (J, C)).astype(float)


def _whole(fleet, visits, agents, lengths, paid, centre, box):
    """Return the linear program's value: columns, then for each target its two prices, then that of a route needed."""
    J, n = visits.shape
    of_layer = np.arange(len(fleet.counts)) == agents[:, None]
    prices = np.vstack([np.eye(n), -np.eye(n)])
    A_eq = np.vstack([visits, prices, np.zeros((1, n))]).T
    below = np.vstack([np.hstack([of_layer, paid]), np.zeros((2 * n + 1, len(fleet.counts) + paid.shape[1]))]).T
    needed = -np.r_[np.ones(J), np.zeros(2 * n), 1.0]
    cost = np.r_[lengths, centre + box, box - centre, _NEEDED * UNIT]
    b_ub = np.r_[fleet.counts, np.ones(paid.shape[1]), -fleet.least if fleet.least > 1 else 0.0]
    return linprog(cost, np.vstack([below, needed]), b_ub, A_eq, np.ones(n)).fun


def _assert_duals(duals, fleet, visits, agents, lengths, paid, centre, box):
    assert duals.value == pytest.approx(_whole(fleet, visits, agents, lengths, paid, centre, box), rel=1e-6)
    assert (abs(duals.pi - centre) <= box + 1e-6).all() and (duals.sigma <= 0.0).all()
    assert len(duals.level) == len(visits) and (duals.level >= -1e-9).all()
    served = visits.T @ duals.level
    assert abs(served - 1.0).max() <= duals.outside + 1e-6
    assert (paid.T @ duals.level <= 1.0 + 1e-6).all()
    assert (np.bincount(agents, duals.level, len(fleet.counts)) <= fleet.counts + 1e-6).all()


@pytest.mark.parametrize("seed", SEEDS)
def test_it_is_the_whole_linear_program(seed):
    rng = np.random.default_rng(seed)
    fleet, visits, agents, lengths, paid = _random(seed)
    master = RestrictedMaster(6, fleet, paid.shape[1], UNIT)
    half = len(visits) // 2
    for part in (slice(0, half), slice(half, None)):  # columns come in turn, with boxes that move
        master.add(visits[part], agents[part], lengths[part], paid[part])
        for box in (1e3, 5.0):
            centre, so_far = rng.uniform(0, 60, 6), slice(0, part.stop)
            duals = master.solve(centre, box, 10.0)
            _assert_duals(
                duals, fleet, visits[so_far], agents[so_far], lengths[so_far], paid[so_far], centre, box
            )  # fmt: skip


@pytest.mark.parametrize("seed", SEEDS)
def test_columns_that_are_dropped_are_gone(seed):
    fleet, visits, agents, lengths, paid = _random(seed)
    master = RestrictedMaster(6, fleet, paid.shape[1], UNIT)
    master.add(visits, agents, lengths, paid)
    master.solve(np.full(6, 20.0), 30.0, 10.0)
    kept = np.random.default_rng(seed).random(len(visits)) < 0.5
    master.keep(kept)
    rest = visits[kept], agents[kept], lengths[kept], paid[kept]
    _assert_duals(master.solve(np.full(6, 20.0), 30.0, 10.0), fleet, *rest, np.full(6, 20.0), 30.0)


def test_a_wide_box_serves_nothing_at_its_prices():
    master = RestrictedMaster(3, Fleet(np.array([3]), 1), 0, UNIT)
    master.add(np.eye(3), [0, 0, 0], [10.0, 20.0, 30.0], np.zeros((3, 0)))
    duals = master.solve(np.zeros(3), 1e6, 10.0)
    assert duals.outside == pytest.approx(0.0, abs=1e-9) and duals.value == pytest.approx(60.0)
    assert duals.level == pytest.approx(np.ones(3)) and duals.pi == pytest.approx(np.array([10.0, 20.0, 30.0]))
