"""The first of many random orders of the targets that one agent can fly in time, in compiled code."""

import numpy as np

from .compiled import compiled
from .motion import earliest_meeting


@compiled
def first_flyable(draws, times, points, depot, end, max_speed, horizon):
    """Return (found, visit times) of the first flyable order; each row of `draws` in [0, 1) shuffles one order.

    An order is shuffled only as far as it is flown: most fail after a few targets.
    """
    n = draws.shape[1]
    order, visits = np.arange(n), np.zeros(n)
    for draw in draws:
        t, px, py = 0.0, depot[0], depot[1]
        for k in range(n):
            pick = k + int(draw[k] * (n - k))
            u = order[pick]
            order[pick], order[k] = order[k], u
            t, px, py = _meet_path(px, py, t, times[u], points[u], max_speed)
            dx, dy = px - end[0], py - end[1]
            if t + np.sqrt(dx * dx + dy * dy) / max_speed > horizon:
                break
            visits[u] = t
        else:
            return True, visits
    return False, visits


@compiled
def first_flyable_near(draws, times, points, depot, end, max_speed, horizon, nearest):
    """Like first_flyable, but each number in a row of `draws` picks one of the `nearest` targets that are met first."""
    n = draws.shape[1]
    visits, meetings = np.zeros(n), np.zeros(n)
    for draw in draws:
        t, px, py = 0.0, depot[0], depot[1]
        done = np.zeros(n, dtype=np.bool_)
        for k in range(n):
            for u in range(n):
                meetings[u] = np.inf if done[u] else _meet_path(px, py, t, times[u], points[u], max_speed)[0]
            u = np.argsort(meetings)[int(draw[k] * min(nearest, n - k))]
            t, px, py = _meet_path(px, py, t, times[u], points[u], max_speed)
            dx, dy = px - end[0], py - end[1]
            if t + np.sqrt(dx * dx + dy * dy) / max_speed > horizon:
                break
            done[u], visits[u] = True, t
        else:
            return True, visits
    return False, visits


@compiled
def _meet_path(px, py, t, times, points, max_speed):
    """Return the earliest (time, x, y) at which an agent at (px, py) at time t meets the target; time inf if never."""
    for piece in range(len(times) - 1):
        start, end = times[piece], times[piece + 1]
        if end < t:
            continue
        x, y = points[piece, 0], points[piece, 1]
        vx, vy = (points[piece + 1, 0] - x) / (end - start), (points[piece + 1, 1] - y) / (end - start)
        meeting = earliest_meeting(px, py, t, x, y, start, vx, vy, start, end, max_speed)
        if meeting < np.inf:
            return meeting, x + (meeting - start) * vx, y + (meeting - start) * vy
    return np.inf, px, py
