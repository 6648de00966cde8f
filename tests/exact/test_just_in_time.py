"""Motions that just suffice and just do not, and targets nearly as fast as the agents."""

import math

import pytest

from mamttsp import Instance, Target, generate, solve
from tests.exact.certificates import assert_certified
from tests.exact.enumeration import optimum
from tests.examples import MAX_SPEED, instance, moving, still


def within(horizon, *targets):
    """Return an instance of stationary targets (x, y) that may be visited at any time up to the horizon."""
    targets = [Target([0.0, horizon], [place, place], [(0.0, horizon)]) for place in targets]
    return Instance(targets, 1, (0.0, 0.0), MAX_SPEED, horizon)


@pytest.mark.parametrize("places, length", [([(30, 40)], 100.0), ([(0, 12), (16, 12), (16, 0)], 56.0)])
def test_a_horizon_that_just_suffices_and_one_that_does_not(places, length):
    assert_certified(within(length / MAX_SPEED, *places), length)
    assert_certified(within(length / MAX_SPEED * (1 - 1e-5), *places), math.inf)


def test_moments_that_can_just_be_reached_and_just_not():
    """(40, 0) at t = 10, then (40, 40) at t = 20: at v_max all the way."""
    assert_certified(instance(still(40, 0, [(10, 10)]), still(40, 40, [(20, 20)])), 80 + 40 * math.sqrt(2))
    assert_certified(instance(still(40, 0, [(10, 10)]), still(40, 40, [(19.999, 19.999)])), math.inf)


def test_a_moving_target_met_at_the_last_moment():
    """It runs away from (10, 0) at 1 unit/s and is met at t = 10/3 at the earliest, when its window ends."""
    assert_certified(instance(moving((10, 0), (1, 0), [(0, 10 / 3)])), 80 / 3)
    assert_certified(instance(moving((10, 0), (1, 0), [(0, 10 / 3 - 1e-4)])), math.inf)


@pytest.mark.parametrize("n, m, seed", [(4, 1, 1), (5, 2, 2), (6, 1, 3)])
def test_order_and_times_without_any_slack(n, m, seed):
    """Windows shrunk to the visits of the best tours and a horizon that ends with them: one solution is left."""
    free = generate(n, 40, m, seed)
    tours = solve(free, gap=1e-6).tours
    visits = {visit.target: visit.time for tour in tours for visit in tour.visits}
    home = max(tour.return_time for tour in tours)
    targets = [Target(t.times, t.points, [(visits[u], visits[u])]) for u, t in enumerate(free.targets)]
    held = Instance(targets, len(tours), free.depot, free.max_speed, max(home, *visits.values()))
    assert_certified(held, optimum(held))


@pytest.mark.parametrize("share", [0.99, 0.99999, 1 - 1e-9])
def test_targets_nearly_as_fast_as_the_agents(share):
    fast = share * MAX_SPEED
    targets = moving((-200, 3), (fast, 0)), moving((10, 200), (0, -fast)), moving((2, 1), (0, fast), [(0, 20)])
    problem = instance(*targets, n_agents=2)
    assert_certified(problem, optimum(problem))


def test_a_chase_that_never_ends():
    """It flies away at nearly v_max: by the end of its window nobody has caught up."""
    assert_certified(instance(moving((1, 0), (MAX_SPEED - 0.01, 0), [(0, 40)])), math.inf)
