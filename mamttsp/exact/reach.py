"""Exact times along a route of targets: how early an agent can be at each stop, and how late it may be there.

Agents are faster than targets, so one that is early can stay with its target, through windows and between them: nothing
is lost by being earlier, and these times alone tell whether a route can be flown, and whether a visit fits in.
"""

from collections import namedtuple

import numpy as np

from ..compiled import compiled
from ..motion import TIME_SLACK, earliest_meeting

#: Segments of target u in rows first[u]:first[u + 1], and behind those of all n targets one where an agent ends: ahead
#: (K, S, 6), of each layer, in order of time: place at its start, velocity, start and end; back (K, S, 6): as seen with
#: time running backward, where agents end at their depot; speed (K,); slack: s that rounding errors may cost
Motion = namedtuple("Motion", "first ahead back speed slack")


def segments_of(graph, u):
    """Return the nodes of target u in the graph's first layer, in order of time."""
    cluster = graph.C(u)
    return cluster[graph.layer[cluster] == 0]


def make_motion(graph, targets):
    """Return the Motion of the targets."""
    nodes = [segments_of(graph, u) for u in targets]
    segments = [np.c_[graph.p_lo[own], graph.v[own], graph.t_lo[own], graph.t_hi[own]] for own in nodes]
    mirrored = [_mirrored(own)[::-1] for own in segments]
    ahead = [np.vstack([*segments, [*end, 0.0, 0.0, 0.0, graph.horizon]]) for end in graph.p_lo[graph.ends]]
    back = [np.vstack([*mirrored, [*depot, 0.0, 0.0, -graph.horizon, 0.0]]) for depot in graph.p_lo[graph.starts]]
    first, slack = np.cumsum([0, *map(len, nodes), 1]), TIME_SLACK * (1.0 + graph.horizon)
    return Motion(first, np.array(ahead), np.array(back), graph.speeds, slack)


def _mirrored(segments):
    x, y, vx, vy, opens, closes = segments.T
    return np.c_[x + (closes - opens) * vx, y + (closes - opens) * vy, -vx, -vy, -closes, -opens]


@compiled
def meet(px, py, t, segments, first, last, speed):
    """Return (x, y, time): where and when an agent that is at (px, py) at time t can first meet one of the segments
    first:last; the time is infinite if it cannot."""
    for s in range(first, last):
        x, y, vx, vy, opens, closes = segments[s]
        time = earliest_meeting(px, py, t, x, y, opens, vx, vy, opens, closes, speed)
        if time < np.inf:
            return x + (time - opens) * vx, y + (time - opens) * vy, time
    return px, py, np.inf


@compiled
def fill_reach(route, length, motion, layer, early, late, ahead, behind):
    """Fill in early (n + 1, 3), where and when an agent of a layer can be behind so many stops, and late (n + 1, 3),
    the same before the last so many of them with time running backward, but of the first `ahead` and the last `behind`
    stops, of which they hold already; return whether the route can be flown."""
    first, forth, back, speed = motion.first, motion.ahead[layer], motion.back[layer], motion.speed[layer]
    early[0, 0], early[0, 1], early[0, 2] = back[-1, 0], back[-1, 1], 0.0
    late[0, 0], late[0, 1], late[0, 2] = forth[-1, 0], forth[-1, 1], back[-1, 4]
    for i in range(ahead, length):
        _next_stop(early, i, forth, first[route[i]], first[route[i] + 1], speed)
    for rest in range(behind, length):
        u = route[length - 1 - rest]
        _next_stop(late, rest, back, first[u], first[u + 1], speed)
    return early[length, 2] < np.inf and late[length, 2] < np.inf


@compiled
def _next_stop(times, i, segments, first, last, speed):
    times[i + 1, 0], times[i + 1, 1], times[i + 1, 2] = meet(
        times[i, 0], times[i, 1], times[i, 2], segments, first, last, speed
    )


@compiled
def fits(w, behind, early, late, first, segments, speed):
    """Tell whether an agent that is where and when `early` (3,) says can meet target w, and then `behind`, a target or
    the end, by the time `late`; first, segments: of the Motion, `ahead` of the agent's layer."""
    x, y, t = meet(early[0], early[1], early[2], segments, first[w], first[w + 1], speed)
    if t == np.inf:
        return False
    _, _, t = meet(x, y, t, segments, first[behind], first[behind + 1], speed)
    return t <= late
