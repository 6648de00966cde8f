"""Stationary targets, windows of every kind, and how many targets and agents there may be."""

import math

import numpy as np
import pytest

from mamttsp import solve
from tests.exact.certificates import assert_brackets, assert_certified
from tests.exact.enumeration import optimum
from tests.examples import instance, moving, still

AROUND = ((40.0, 60.0),)


@pytest.mark.parametrize("m", [1, 2, 7])
def test_stationary_targets(m):
    places = [(10, 0), (0, 10), (10, 10), (-7, 3), (-20, -20), (15, -8)]
    problem = instance(*(still(*place) for place in places), n_agents=m)
    assert_certified(problem, optimum(problem))


def test_stationary_targets_in_one_place():
    assert_certified(instance(*[still(6, 8)] * 5, n_agents=2), 20.0)


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
    solution = solve(problem, time_limit=10.0)
    assert_brackets(problem, solution, 20.0)
    assert solution.tours


@pytest.mark.parametrize("n", [64, 65, 129])
def test_sets_of_targets_take_as_many_words_as_they_need(n):
    problem = along_a_ray(n)
    assert_brackets(problem, solve(problem, time_limit=1.0), 20.0)
