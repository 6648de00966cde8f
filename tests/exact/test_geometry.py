"""Hostile geometry: meetings, windows without length, motions that just suffice, the optimum 0, tiny and huge units."""

import math

import numpy as np
import pytest
from examples import HORIZON, MAX_SPEED, instance, moving, still
from exact.certificates import assert_brackets, assert_certified
from exact.enumeration import optimum

from mamttsp import InputError, Instance, Target, generate, solve

AROUND = ((40.0, 60.0),)
#: what passes (20, 0) at t = 50 at right angles to the way from the depot is nowhere nearer to it
PLACE = np.array([20.0, 0.0])


def through(velocity, place=PLACE, windows=AROUND):
    """Return a target that is at `place` at t = 50."""
    return moving(np.subtract(place, 50.0 * np.asarray(velocity)), velocity, windows)


# --- Targets that meet where the best tour passes: legs of length zero, where the distance has a kink ----------------


@pytest.mark.parametrize("m", [1, 2])
@pytest.mark.parametrize("speeds", [(0.7, -0.7), (0.9, -0.4), (0.9, -0.4, 0.2), (1.0, 0.5, 0.0, -0.5, -1.0)])
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


# --- The depot -------------------------------------------------------------------------------------------------------


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


# --- Stationary targets ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("m", [1, 2, 7])
def test_stationary_targets(m):
    places = [(10, 0), (0, 10), (10, 10), (-7, 3), (-20, -20), (15, -8)]
    problem = instance(*(still(*place) for place in places), n_agents=m)
    assert_certified(problem, optimum(problem))


def test_stationary_targets_in_one_place():
    assert_certified(instance(*[still(6, 8)] * 5, n_agents=2), 20.0)


# --- Windows ---------------------------------------------------------------------------------------------------------


def test_windows_of_length_zero():
    moments = [[(t, t)] for t in (12.0, 30.0, 55.0, 80.0)]
    problem = instance(*(moving((10, -20), (0.1 * k, 0.5), moment) for k, moment in enumerate(moments)))
    places = [(0.0, 0.0), *(tuple(t.position(t.windows[0, 0])) for t in problem.targets), (0.0, 0.0)]
    assert_certified(problem, sum(math.dist(p, q) for p, q in zip(places[:-1], places[1:])))


def test_moments_and_long_windows():
    moments = moving((10, 5), (0.3, 0.2), [(20, 20), (60, 60)]), still(-10, 5, [(0, 0), (35, 35)])
    problem = instance(*moments, moving((0, 30), (0.2, -0.5)), still(8, -8, AROUND), n_agents=2)
    assert_certified(problem, optimum(problem))


def test_windows_that_touch_are_one():
    def problem(windows):
        return instance(moving((-30, 6), (1, 0), windows), moving((20, 10), (0, -0.6), windows), still(5, 5, windows))

    expected = optimum(problem([(10, 60)]))
    assert_certified(problem([(10, 60)]), expected)
    assert_certified(problem([(10, 25), (25, 25), (25, 30), (30, 60)]), expected)


@pytest.mark.parametrize("m", [1, 4])
def test_a_window_that_no_agent_reaches(m):
    far = still(90, 0, [(0, 22)])
    assert_certified(instance(still(5, 0), far, moving((10, 10), (0.2, 0)), n_agents=m), math.inf)


def test_windows_that_each_agent_reaches_but_not_all():
    """Five appointments at one time far apart, and four agents; no pair of them alone shows that."""
    around = [(40 * math.cos(a), 40 * math.sin(a)) for a in np.linspace(0, 5, 5)]
    appointments = [still(*place, [(20, 21)]) for place in around]
    assert_certified(instance(*appointments, n_agents=4), math.inf)
    assert_certified(instance(*appointments, n_agents=5), 400.0)


# --- How many --------------------------------------------------------------------------------------------------------


def test_one_target():
    assert_certified(instance(still(30, 40)), 100.0)
    assert_certified(instance(moving((-40, 6), (1, 0), [(20, 60)])), 12.0)


def test_more_agents_than_targets():
    problem = instance(still(10, 0, [(5, 6)]), still(-10, 0, [(5, 6)]), n_agents=50)
    assert_certified(problem, 40.0)


def along_a_ray(n_targets):
    """Return an instance of targets that may be visited at any time, on the way to the last one at (10, 0) and back."""
    return instance(*(still(10.0 * k / n_targets, 0) for k in range(1, n_targets + 1)))


def test_many_targets_close_together_without_windows():
    """More visits follow each other within seconds than any even grid of times has room for."""
    problem = along_a_ray(30)
    solution = solve(problem, time_limit=3.0)
    assert_brackets(problem, solution, 20.0)
    assert solution.tours


def test_more_targets_than_the_method_takes():
    problem = along_a_ray(64)
    assert_brackets(problem, solve(problem, time_limit=1.0), 20.0)
    with pytest.raises(InputError, match='^targets: method "exact" takes at most 64, found 65$'):
        solve(along_a_ray(65))


# --- Just in time ----------------------------------------------------------------------------------------------------


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
    """Windows shrunk to the visits of the best tours, and a horizon that ends with them: exactly one solution is left."""
    free = generate(n, 40, m, seed)
    tours = solve(free, gap=1e-6).tours
    visits = {visit.target: visit.time for tour in tours for visit in tour.visits}
    home = max(tour.return_time for tour in tours)
    targets = [Target(t.times, t.points, [(visits[u], visits[u])]) for u, t in enumerate(free.targets)]
    held = Instance(targets, len(tours), free.depot, free.max_speed, max(home, *visits.values()))
    assert_certified(held, optimum(held))


# --- Nearly as fast as the agents ------------------------------------------------------------------------------------


@pytest.mark.parametrize("share", [0.99, 0.99999, 1 - 1e-9])
def test_targets_nearly_as_fast_as_the_agents(share):
    fast = share * MAX_SPEED
    targets = moving((-200, 3), (fast, 0)), moving((10, 200), (0, -fast)), moving((2, 1), (0, fast), [(0, 20)])
    problem = instance(*targets, n_agents=2)
    assert_certified(problem, optimum(problem))


def test_a_chase_that_never_ends():
    """It flies away at nearly v_max: by the end of its window nobody has caught up."""
    assert_certified(instance(moving((1, 0), (MAX_SPEED - 0.01, 0), [(0, 40)])), math.inf)


# --- Units -----------------------------------------------------------------------------------------------------------


def scaled(problem, space, time):
    """Return the instance in other units: lengths times `space`, times times `time`."""
    targets = [Target(t.times * time, t.points * space, t.windows * time) for t in problem.targets]
    speed = problem.max_speed * space / time
    return Instance(targets, problem.n_agents, problem.depot * space, speed, problem.horizon * time)


@pytest.mark.parametrize("space, time", [(1e-3, 1.0), (1e4, 1.0), (1e6, 1.0), (1.0, 1e-3), (1.0, 1e4), (1e6, 3600.0)])
@pytest.mark.parametrize("n, m, seed", [(5, 1, 3), (6, 2, 4)])
def test_units_do_not_matter(n, m, seed, space, time):
    problem = generate(n, 40, m, seed)
    assert_certified(scaled(problem, space, time), space * optimum(problem))


def test_far_from_the_origin():
    problem = generate(5, 40, 2, seed=5)
    targets = [Target(t.times, t.points + 1e5, t.windows) for t in problem.targets]
    moved = Instance(targets, 2, problem.depot + 1e5, problem.max_speed, problem.horizon)
    assert_certified(moved, optimum(problem))


def test_a_horizon_far_beyond_all_windows():
    problem = generate(5, 40, 1, seed=6)
    assert_certified(Instance(problem.targets, 1, problem.depot, problem.max_speed, 1e7), optimum(problem))


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
