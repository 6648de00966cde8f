"""Targets that meet where the best tours pass, legs of length zero with a kink in the distance, and the optimum 0."""

import math

import numpy as np
import pytest

from tests.exact.certificates import assert_certified
from tests.exact.enumeration import optimum
from tests.examples import HORIZON, instance, moving, still

AROUND = ((40.0, 60.0),)
#: what passes (20, 0) at t = 50 at right angles to the way from the depot is nowhere nearer to it
PLACE = np.array([20.0, 0.0])


def through(velocity, place=PLACE, windows=AROUND):
    """Return a target that is at `place` at t = 50."""
    return moving(np.subtract(place, 50.0 * np.asarray(velocity)), velocity, windows)


@pytest.mark.parametrize("m", [1, 2])
@pytest.mark.parametrize(
    "speeds",
    [(0.7, -0.7), (0.9, -0.4), (0.9, -0.4, 0.2), (1.0, 0.5, 0.0, -0.5, -1.0), (1.0, 0.6, 0.2, -0.2, -0.6, -1.0)],
)
def test_targets_that_meet_at_a_point_are_visited_there(speeds, m):
    problem = instance(*(through((0.0, speed)) for speed in speeds), n_agents=m)
    assert_certified(problem, 2 * PLACE[0])


@pytest.mark.parametrize("n_targets", [2, 4])
@pytest.mark.parametrize("velocity", [(0.0, 0.7), (0.5, 0.3)])
def test_targets_on_one_path(velocity, n_targets):
    together = instance(*[through(velocity)] * n_targets)
    alone = instance(through(velocity))
    assert_certified(together, optimum(alone))


def test_targets_that_follow_each_other_on_one_path():
    apart = [moving((10, -20 - gap), (0, 0.8), [(10, 60)]) for gap in (0, 1, 5, 8)]
    problem = instance(*apart, n_agents=2)
    assert_certified(problem, optimum(problem))


@pytest.mark.parametrize("m", [1, 2])
@pytest.mark.parametrize("miss", [0.0, 1e-9, 1e-6, 1e-4, 1e-2, 1.0])
def test_targets_that_cross_or_nearly_cross(miss, m):
    crossing = through((0.6, 0.5)), through((-0.5, 0.7), PLACE + (0.0, miss))
    problem = instance(*crossing, still(5, -20, AROUND), moving((-30, 5), (0.4, 0.0)), n_agents=m)
    assert_certified(problem, optimum(problem))


def test_three_targets_meet_among_others():
    meeting = [through(velocity) for velocity in ((0.6, 0.5), (-0.5, 0.7), (0.0, -0.9))]
    problem = instance(*meeting, still(-10, 10), moving((30, 30), (-0.5, 0.0), [(5, 90)]))
    assert_certified(problem, optimum(problem))


@pytest.mark.parametrize("seed", range(6))
def test_what_lies_on_a_grid(seed):
    """Whole coordinates and few headings: targets that meet, run side by side or follow each other, and many ties."""
    rng = np.random.default_rng(seed)
    headings = [(0, 0), (1, 0), (0, 1), (-1, 0), (0, -1)]
    targets = [moving(rng.integers(-3, 4, 2) * 10, headings[rng.integers(5)], _window(rng)) for _ in range(5)]
    problem = instance(*targets, n_agents=1 + seed % 3)
    assert_certified(problem, optimum(problem))


def _window(rng):
    start = 10.0 * rng.integers(0, 7)
    return [(start, min(start + 10.0 * rng.integers(1, 4), HORIZON))]


def test_a_target_through_the_depot_costs_nothing():
    assert_certified(instance(through((0.6, 0.3), (0, 0))), 0.0)


def test_a_target_through_the_depot_with_others():
    problem = instance(through((0.6, 0.3), (0, 0)), still(10, 5), moving((-20, 3), (0.3, 0.3), [(5, 70)]), n_agents=2)
    assert_certified(problem, optimum(problem))


@pytest.mark.parametrize("m", [1, 3])
def test_all_targets_at_the_depot(m):
    assert_certified(instance(still(0, 0), still(0, 0, [(5, 5)]), still(0, 0, AROUND), n_agents=m), 0.0)


def test_all_targets_through_the_depot_at_different_times():
    passing = [moving((-t, 0.0), (1.0, 0.0), [(t - 5, t + 5)]) for t in (20.0, 50.0, 80.0)]
    assert_certified(instance(*passing), 0.0)


@pytest.mark.parametrize("m, expected", [(1, 40.0), (2, 20 + 10 * math.sqrt(2))])
def test_a_target_at_the_depot_with_others(m, expected):
    """One agent has to pass by between the others; of two, the second one need not move."""
    problem = instance(still(0, 0, AROUND), still(10, 0, [(30, 35)]), still(0, 10, [(70, 75)]), n_agents=m)
    assert_certified(problem, expected)
