"""The oracle on instances whose optimum can be worked out by hand: what every other agreement rests on."""

import math

import pytest

from tests.examples import agents, general, instance, moving, still
from tests.oracle import optimum, subsets


def test_one_target_is_flown_to_and_back():
    assert optimum(instance(still(3, 4))) == pytest.approx(10.0)


def test_a_target_that_runs_away_is_met_as_soon_as_can_be():
    # 10 + t = 4 t at t = 10/3, at 40/3 units
    assert optimum(instance(moving((10, 0), (1, 0)))) == pytest.approx(80 / 3, rel=1e-7)


def test_a_target_that_comes_is_awaited():
    # It is nearest, at (0, 6), at t = 40, in the middle of its window.
    assert optimum(instance(moving((-40, 6), (1, 0), [(20, 60)]))) == pytest.approx(12.0, rel=1e-6)


def test_the_better_of_two_windows_is_chosen():
    target = moving((50, 0), (-0.5, 0), [(10, 20), (70, 80)])  # from 45 to 40, and from 15 to 10
    assert optimum(instance(target)) == pytest.approx(20.0, rel=1e-6)


def test_stationary_targets_on_a_square_are_a_travelling_salesman():
    corners = [still(*corner) for corner in ((0, 10), (10, 10), (10, 0))]
    assert optimum(instance(*corners)) == pytest.approx(40.0)


@pytest.mark.parametrize("n_agents, expected", [(1, math.inf), (2, 40.0), (3, 40.0)])
def test_two_appointments_at_the_same_time_need_two_agents(n_agents, expected):
    appointments = still(10, 0, [(5, 6)]), still(-10, 0, [(5, 6)])
    assert optimum(instance(*appointments, n_agents=n_agents)) == pytest.approx(expected)


@pytest.mark.parametrize("n_agents, expected", [(1, 2 + 2 * math.sqrt(2)), (2, 4.0)])
def test_a_second_agent_saves_a_way_that_the_appointments_force(n_agents, expected):
    # Alone: right, up and right again. Together: one agent waits on each side.
    right, up = (1, 0), (0, 1)
    targets = still(*right, [(10, 11)]), still(*up, [(20, 21)]), still(*right, [(30, 31)])
    assert optimum(instance(*targets, n_agents=n_agents)) == pytest.approx(expected)


def test_no_agent_can_be_back_in_time():
    assert optimum(instance(still(100, 0, [(90, 100)]), n_agents=3)) == math.inf


def test_targets_that_meet_are_still_flown_to():
    # Both are at (50, 0) when t = 10. The one that runs away is met at t = 40/3, at 160/3 units, and the other one,
    # at (48, 0) when t = 12, on the way there.
    meeting = moving((40, 0), (1, 0), [(0, 20)]), moving((60, 0), (-1, 0), [(0, 20)])
    assert optimum(instance(*meeting)) == pytest.approx(320 / 3, rel=1e-6)


def test_the_nearer_depot_and_the_nearer_end_are_taken():
    far, near = agents(depot=(-50.0, 0.0)), agents(depot=(20.0, 0.0), end=(30.0, 0.0))
    assert optimum(general(still(25, 0), types=[far])) == pytest.approx(150.0)
    assert optimum(general(still(25, 0), types=[far, near])) == pytest.approx(10.0)


def test_only_the_fast_agent_makes_both_appointments():
    appointments = still(10, 0, [(5, 6)]), still(-10, 0, [(9, 10)])
    assert optimum(general(*appointments, types=[agents(1, max_speed=3.9)])) == math.inf
    assert optimum(general(*appointments, types=[agents(1, max_speed=4.1)])) == pytest.approx(40.0)


ROOT = math.sqrt(200)  # from the depot to the far corner


@pytest.mark.parametrize(
    "capacity, expected", [(None, 40.0), (3.0, 40.0), (2.0, 40 + ROOT), (1.0, 40 + 2 * ROOT), (0.5, math.inf)]
)
def test_capacity_divides_the_square(capacity, expected):
    corners = [still(0, 10, demand=1.0), still(10, 10, demand=1.0), still(10, 0, demand=1.0)]
    assert optimum(general(*corners, types=[agents(3, capacity=capacity)])) == pytest.approx(expected)


def test_of_each_type_no_more_agents_than_there_are():
    """Two appointments at a time: the near depot has one agent, so the other one comes from far."""
    pair = still(10, 0, [(5, 6)]), still(-10, 0, [(5, 6)])
    types = [agents(1), agents(1, depot=(30.0, 0.0), max_speed=8.0)]
    assert optimum(general(*pair, types=types)) == pytest.approx(20.0 + 40.0)
    assert optimum(general(*pair, types=[agents(2), types[1]])) == pytest.approx(40.0)


def test_subsets():
    assert subsets(range(2)) == [frozenset(), {0}, {1}, {0, 1}]
