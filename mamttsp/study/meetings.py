"""Where targets meet or nearly meet inside their windows: there the formulations accept cycles that nobody flies."""

import itertools
from typing import NamedTuple

import numpy as np

from ..graph import segments
from ..instance import Instance, Target

#: targets count as meeting if they are closer than this share of the instance's size
TOLERANCE = 1e-9


class Encounter(NamedTuple):
    """The closest that two segments of different targets come while both can be visited.

    miss: their distance in units; time: when, in s (the earliest such moment); targets: the two, from 0.
    """

    miss: float
    time: float
    targets: tuple


def encounters(instance):
    """Return the Encounters of all pairs of segments that share a moment, the closest first."""
    parts = [(u, part) for u, target in enumerate(instance.targets) for part in segments(target)]
    pairs = ((a, b) for a, b in itertools.combinations(parts, 2) if a[0] != b[0])
    found = (_closest(u, part, w, other) for (u, part), (w, other) in pairs)
    return sorted(encounter for encounter in found if encounter is not None)


def _closest(u, part, w, other):
    """Return the Encounter of two segments (t_lo, t_hi, p_lo, p_hi, v), None if no moment is in both."""
    start, end = max(part[0], other[0]), min(part[1], other[1])
    if start > end:
        return None
    velocity = other[4] - part[4]
    apart = (other[2] + (start - other[0]) * other[4]) - (part[2] + (start - part[0]) * part[4])
    speed2 = float(velocity @ velocity)
    wait = 0.0 if speed2 == 0.0 else min(max(-float(apart @ velocity) / speed2, 0.0), end - start)
    return Encounter(float(np.hypot(*(apart + wait * velocity))), float(start + wait), (u, w))


def meeting_groups(instance):
    """Return the sets of targets that are in one place at one moment, all inside windows; those within others left out.

    Every set of two or more targets that meet is a subset of one of them. Such subsets are all that a cycle of zero
    length can visit.
    """
    near = TOLERANCE * instance.size
    moments = [(e.time, e.targets[0]) for e in encounters(instance) if e.miss <= near]
    groups = {_together(instance, t, u, near) for t, u in moments}
    return sorted(sorted(group) for group in groups if not any(group < other for other in groups))


def _together(instance, t, u, near):
    """Return the targets that can be visited at time t where target u is then."""
    slack = TOLERANCE * instance.horizon
    place = instance.targets[u].position(t)
    return frozenset(
        w
        for w, target in enumerate(instance.targets)
        if np.hypot(*(target.position(t) - place)) <= near
        and any(start - slack <= t <= end + slack for start, end in target.windows)
    )


def subsets_that_meet(instance):
    """Return every set of two or more targets that meet, as sorted tuples: the sets S whose cuts close the hole."""
    found = {
        subset
        for group in meeting_groups(instance)
        for size in range(2, len(group) + 1)
        for subset in itertools.combinations(group, size)
    }
    return sorted(found, key=lambda subset: (len(subset), subset))


def passing(miss=0.0, n_passing=2):
    """Return an Instance where targets pass each other far from the depot: `miss` units apart, or meeting if it is 0.

    Target 0 stands still 10 units from the depot. Targets 1 to n_passing (at most 3) can be visited from 45 s to 55 s
    only, and are at 50 s all near (60, 0). One agent; v_max = 4 units/s, horizon 100 s.
    """
    still = Target([0.0, 100.0], [[10.0, 0.0], [10.0, 0.0]], [(0.0, 100.0)])
    movers = []
    for k, velocity in enumerate(np.array([[0.5, 0.3], [-0.4, 0.6], [0.0, -0.7]])[:n_passing]):
        place = np.array([60.0, k * miss])
        movers.append(Target([0.0, 100.0], [place - 50.0 * velocity, place + 50.0 * velocity], [(45.0, 55.0)]))
    return Instance([still, *movers], 1, (0.0, 0.0), 4.0, 100.0)
