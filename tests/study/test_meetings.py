"""Where targets meet: held against dense sampling, and against instances made to meet."""

import numpy as np
import pytest

from mamttsp import Target, generate
from mamttsp.study.meetings import encounters, meeting_groups, passing, subsets_that_meet
from tests.examples import instance, moving, still
from tests.meetings import MEETING, PLACE, three_at_one_point, through, two_on_one_path
from tests.oracle import optimum


@pytest.mark.parametrize("seed", range(3))
def test_the_nearest_encounter_is_what_sampling_finds(seed):
    problem = generate(5, 60, seed=seed)
    times = np.linspace(0.0, problem.horizon, 60001)
    places = np.array([[target.position(t) for t in times] for target in problem.targets])
    inside = np.array([[any(a <= t <= b for a, b in target.windows) for t in times] for target in problem.targets])
    sampled = min(
        np.linalg.norm(places[u] - places[w], axis=1)[inside[u] & inside[w]].min(initial=np.inf)
        for u in range(5)
        for w in range(u)
    )
    nearest = encounters(problem)[0]
    u, w = (problem.targets[k].position(nearest.time) for k in nearest.targets)
    assert np.linalg.norm(u - w) == pytest.approx(nearest.miss, abs=1e-9)
    assert sampled - 0.01 < nearest.miss < sampled + 1e-9


def test_targets_that_pass():
    nearest = encounters(passing(0.1))[0]
    assert nearest.targets == (1, 2) and 0.05 < nearest.miss <= 0.1 and 45 < nearest.time < 55
    assert meeting_groups(passing(0.1)) == [] and subsets_that_meet(passing(0.1)) == []


def test_targets_that_meet():
    nearest = encounters(passing())[0]
    assert nearest == (pytest.approx(0.0, abs=1e-9), pytest.approx(50.0), (1, 2))
    assert optimum(passing()) > 100 and optimum(passing(0.0, 3)) > 100
    assert subsets_that_meet(passing()) == [(1, 2)]


def test_every_set_of_those_that_meet_is_listed():
    assert meeting_groups(three_at_one_point()) == [[1, 2, 3]]
    assert subsets_that_meet(passing(0.0, 3)) == [(1, 2), (1, 3), (2, 3), (1, 2, 3)]


def test_two_meetings_at_different_times_are_no_meeting_of_three():
    """Target 1 meets target 0 at 46 s and target 2 at 54 s."""
    line = through(PLACE, (0.5, 0.0))
    first, last = (moving(line.position(t) - t * np.array([0.0, 0.5]), (0.0, 0.5), [(45, 55)]) for t in (46.0, 54.0))
    assert subsets_that_meet(instance(first, line, last)) == [(0, 1), (1, 2)]


def test_targets_on_one_path_meet_and_a_window_that_opens_late_counts():
    assert meeting_groups(two_on_one_path()) == [[1, 2]]
    late = instance(
        still(10, 0, [(0, 20)]), still(10, 0, [(0, 30)]), still(10, 0, [(15, 30)]), still(10, 0, [(25, 30)])
    )
    assert meeting_groups(late) == [[0, 1, 2], [1, 2, 3]]


def test_windows_that_touch_in_one_moment_are_enough_and_a_closed_one_is_not():
    crossing = through(PLACE, (0.5, 0.3))
    for window, groups in (((MEETING, 60.0), [[0, 1]]), ((MEETING + 0.1, 60.0), [])):
        other = moving(PLACE - MEETING * np.array([-0.4, 0.6]), (-0.4, 0.6), [window])
        assert meeting_groups(instance(crossing, other)) == groups


def test_a_meeting_at_a_bend_is_found_once():
    turning = Target([0, 50, 100], [[35, -15], [60, 0], [35, 15]], [(45, 55)])
    assert subsets_that_meet(instance(turning, through(PLACE, (-0.4, 0.6)))) == [(0, 1)]
