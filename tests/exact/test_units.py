"""Millimetres, thousands of kilometres, milliseconds and weeks; far from the origin and long after all windows."""

import pytest

from mamttsp import Instance, Target, generate
from tests.exact.certificates import assert_certified
from tests.exact.enumeration import optimum


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
