"""When each edge can be flown, given the edges that are left: earliest and latest times, carried along the edges.

An only agent must visit every target, before an edge or after it. An edge that leaves some target no time for either is
never flown.
"""

import math

import numpy as np

from ..compiled import compiled
from ..motion import earliest_meeting

#: s; sweeps go on while some time moves by more than this
_STEP = 1e-6
_MAX_SWEEPS = 100


def propagate(graph, alive, alone=False):
    """Return (alive, times): the edges that can still be flown, and when, or None if some target cannot be reached.

    alive: (|E|,) of bool; alone: whether there is one agent only; times: (|E|, 4), the earliest and latest departure
    and the earliest and latest arrival of each edge in s. Whatever the edges in `alive` allow, tours or not, keeps to
    these times: every bound starts at the node's own time window and is only moved as far as all edges into (out of)
    the node demand. An agent that is alone also does without the edges for which it would miss a target.
    """
    alive = alive.copy()
    tail, head = graph.edges.T
    times = np.empty((len(alive), 4))
    g = graph
    speed = g.speeds[g.layer[tail]]
    dropped = True
    while dropped:
        early, late = _sweep(alive, times, tail, head, g.t_lo, g.t_hi, g.p_lo, g.p_hi, g.v, speed, g.starts, g.ends)
        dropped = alone and _drop(alive, times, tail, head, g.tau, early, late, g.t_lo, g.p_lo, g.v, speed)
    entered = np.zeros(g.n_targets + 1, dtype=bool)
    entered[g.tau[head[alive]]] = True  # tau of an s' is -1: the extra entry
    return (alive, times) if entered[:-1].all() else None


@compiled
def _sweep(alive, times, tail, head, t_lo, t_hi, p_lo, p_hi, v, speed, starts, ends):
    early, late = t_lo.copy(), t_hi.copy()
    for _ in range(_MAX_SWEEPS):
        first, final = np.full(len(early), math.inf), np.full(len(early), -math.inf)
        for e in range(len(alive)):
            if not alive[e]:
                continue
            i, j = tail[e], head[e]
            arrival = earliest_arrival(i, j, early[i], max(early[j], t_lo[j]), late[j], t_lo, p_lo, v, speed[e])
            departure = _departure(i, j, late[j], early[i], late[i], t_hi, p_hi, v, speed[e])
            if math.isinf(arrival) or math.isinf(departure):
                alive[e] = False
                continue
            times[e, 0], times[e, 1], times[e, 2], times[e, 3] = early[i], departure, arrival, late[j]
            first[j] = min(first[j], arrival)
            final[i] = max(final[i], departure)
        first[starts], final[ends] = early[starts], late[ends]
        moved = False
        for i in range(len(early)):
            # A node that no edge enters or leaves ends up with an empty interval, which stops its other edges.
            moved = moved or first[i] > early[i] + _STEP or final[i] < late[i] - _STEP
            early[i], late[i] = max(early[i], first[i]), min(late[i], final[i])
        if not moved:
            break
    return early, late


@compiled
def _drop(alive, times, tail, head, tau, early, late, t_lo, p_lo, v, speed):
    """Take away the edges that leave a target no time before them and none after; tell whether there were any."""
    dropped = False
    for e in range(len(alive)):
        if not alive[e]:
            continue
        i, j = tail[e], head[e]
        visited = np.zeros(tau.max() + 1, dtype=np.bool_)
        for k in range(len(tau)):
            if tau[k] < 0 or visited[tau[k]]:
                continue
            before = earliest_arrival(k, i, early[k], early[i], times[e, 1], t_lo, p_lo, v, speed[e])
            after = earliest_arrival(j, k, times[e, 2], early[k], late[k], t_lo, p_lo, v, speed[e])
            not_home = tau[j] >= 0  # from where nobody flies on
            own = tau[k] == tau[i] or tau[k] == tau[j]
            visited[tau[k]] = own or before < math.inf or (not_home and after < math.inf)
        if not visited.all():
            alive[e], dropped = False, True
    return dropped


@compiled
def earliest_arrival(i, j, t, start, end, t_lo, p_lo, v, speed):
    """Return the earliest time in [start, end] at j after leaving i at time t, infinity if there is none."""
    if math.isinf(t) or start > end:
        return math.inf
    px, py = p_lo[i, 0] + (t - t_lo[i]) * v[i, 0], p_lo[i, 1] + (t - t_lo[i]) * v[i, 1]
    return earliest_meeting(px, py, t, p_lo[j, 0], p_lo[j, 1], t_lo[j], v[j, 0], v[j, 1], start, end, speed)


@compiled
def _departure(i, j, t, start, end, t_hi, p_hi, v, speed):
    """Return the latest time in [start, end] at i that reaches j at time t, minus infinity if there is none.

    With time reversed it is the earliest meeting with i after leaving j.
    """
    if math.isinf(t) or start > end:
        return -math.inf
    px, py = p_hi[j, 0] + (t - t_hi[j]) * v[j, 0], p_hi[j, 1] + (t - t_hi[j]) * v[j, 1]
    return -earliest_meeting(px, py, -t, p_hi[i, 0], p_hi[i, 1], -t_hi[i], -v[i, 0], -v[i, 1], -end, -start, speed)
