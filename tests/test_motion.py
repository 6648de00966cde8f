"""The closed forms of motion.py against their definitions."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mamttsp.motion import earliest_meeting, travel_time

SPEED = 4.0
coordinate = st.floats(-50, 50)
velocity = st.floats(-2, 2)


@settings(max_examples=200)
@given(coordinate, coordinate, velocity, velocity)
def test_an_agent_catches_the_mover_after_the_travel_time_and_not_before(dx, dy, vx, vy):
    s = travel_time(dx, dy, vx, vy, SPEED)
    assert math.hypot(dx + vx * s, dy + vy * s) == pytest.approx(SPEED * s, abs=1e-9)
    before = 0.999 * s
    assert s == 0 or math.hypot(dx + vx * before, dy + vy * before) > SPEED * before


def test_travel_time_by_hand():
    assert travel_time(8.0, 0.0, 0.0, 0.0, SPEED) == pytest.approx(2.0)
    assert travel_time(9.0, 0.0, 1.0, 0.0, SPEED) == pytest.approx(3.0)  # runs away
    assert travel_time(10.0, 0.0, -1.0, 0.0, SPEED) == pytest.approx(2.0)  # comes closer
    assert travel_time(0.0, 0.0, 1.0, 1.0, SPEED) == 0.0


@settings(max_examples=100)
@given(
    coordinate,
    coordinate,
    coordinate,
    coordinate,
    velocity,
    velocity,
    st.floats(0, 30),
    st.floats(0, 40),
    st.floats(0, 30),
)
def test_the_earliest_meeting_is_the_first_moment_within_reach(px, py, qx, qy, vx, vy, t, start, length):
    end = start + length
    found = earliest_meeting(px, py, t, qx, qy, 5.0, vx, vy, start, end, SPEED)
    moments = np.linspace(start, end, 2001)
    distance = np.hypot(qx + (moments - 5.0) * vx - px, qy + (moments - 5.0) * vy - py)
    reachable = moments[distance <= SPEED * (moments - t)]
    step = length / 2000 + 1e-6
    if math.isinf(found):
        assert not len(reachable)
    else:
        assert start <= found <= end
        assert math.hypot(qx + (found - 5.0) * vx - px, qy + (found - 5.0) * vy - py) <= SPEED * (found - t) + 1e-6
        assert not len(reachable) or found <= reachable[0] + 1e-6
        assert found >= end - step or (len(reachable) and found >= reachable[0] - step)


@pytest.mark.parametrize(
    "t, start, end, expected",
    [
        (0.0, 10.0, 20.0, 10.0),  # there early: it waits for the interval
        (0.0, 1.0, 20.0, 2.0),  # still on its way when the interval starts
        (5.0, 1.0, 20.0, 7.0),  # sets out late
        (0.0, 1.0, 2.0, 2.0),  # just in time
        (0.0, 1.0, 1.9, math.inf),  # too late
    ],
)
def test_meeting_a_mover_that_stands_eight_units_away(t, start, end, expected):
    assert earliest_meeting(0.0, 0.0, t, 8.0, 0.0, 0.0, 0.0, 0.0, start, end, SPEED) == pytest.approx(expected)
