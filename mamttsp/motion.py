"""Straight motion in time: where a mover is, and when an agent can first meet it.

Everything here is a closed form in plain floats, compiled by numba, so that the generator, the graph and the
exact solver share one definition. A motion is `p(t) = p0 + (t - t0) * v`; lengths are units, times seconds.
"""

import math

from .compiled import compiled

#: relative slack within which a meeting at the very end of an interval still counts as in time
TIME_SLACK = 1e-9


@compiled
def travel_time(dx, dy, vx, vy, speed):
    """Return the shortest time in which an agent of `speed` catches a mover now at offset (dx, dy).

    The mover keeps the velocity (vx, vy), slower than the agent, so there is exactly one answer: the positive root of
    |d + v s| = speed * s.
    """
    along = dx * vx + dy * vy
    distance2 = dx * dx + dy * dy
    closing = speed * speed - vx * vx - vy * vy
    return (along + math.sqrt(along * along + closing * distance2)) / closing


@compiled
def earliest_meeting(px, py, t, qx, qy, tq, vx, vy, start, end, speed):
    """Return the earliest time in [start, end] at which an agent that is at (px, py) at time t can be at the mover.

    The mover is at (qx, qy) at time tq with velocity (vx, vy). The answer is infinity if the interval ends before
    the agent arrives. An agent that arrives before `start` waits; because movers are slower than agents it can then
    meet the mover at every later time too.
    """
    now = max(t, start)
    dx = qx + (now - tq) * vx - px
    dy = qy + (now - tq) * vy - py
    # Head start: between t and `start` the agent has flown already, so it needs to cover the rest only.
    if dx * dx + dy * dy <= (speed * (now - t)) ** 2:
        meeting = now
    else:
        dx = qx + (t - tq) * vx - px
        dy = qy + (t - tq) * vy - py
        meeting = max(now, t + travel_time(dx, dy, vx, vy, speed))
    if meeting <= end:
        return meeting
    if meeting <= end + TIME_SLACK * (1.0 + abs(end)):
        return end
    return math.inf
