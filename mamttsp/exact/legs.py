"""Affine minorants of the flown distance: of one leg, and of a leg before or behind a value that is affine in time.

On two pieces (q, r) of segments the distance d(t_q, t_r) = ||p_r(t_r) - p_q(t_q)|| is jointly convex, so its tangent
plane at the two middles lies below it everywhere. The speed limit d <= v (t_r - t_q) comes into a leg with its best
Lagrange multiplier eta >= 0: it implies d >= (1 + eta) d - eta v (t_r - t_q), whose right side is affine below. All
bounds of the exact solver are sums of these, so they hold for every real tour.
"""

import math

from ..compiled import compiled, inlined

#: multipliers of the speed limit stop here: for targets almost as fast as agents they grow without end, and with them
#: rounding errors
_LARGEST = 1e6


@compiled
def tangent(dx, dy, vqx, vqy, vrx, vry):
    """Return the distance |d| and its slopes in the time at the tail and at the head."""
    d = math.hypot(dx, dy)
    if d == 0.0:
        return 0.0, 0.0, 0.0
    return d, -(dx * vqx + dy * vqy) / d, (dx * vrx + dy * vry) / d


@inlined
def before_leg(c, slope_q, slope_r, left, right, width_q, width_r, gap, speed):
    """Return (left, right) at the ends of q of: a leg from q to r, then a value (left, right) at r.

    c: the leg's minorant at the starts of both pieces, slope_q, slope_r: its slopes; gap: start of r less start of q
    in s.
    """
    rise = slope_r * width_r + (right - left)
    if rise <= 0.0 or width_r <= 0.0:  # best at the end of r, where time is no obstacle
        value = c + min(left, left + rise)
        return value, value + slope_q * width_q
    eta = min(rise / (width_r * (speed - slope_r)), _LARGEST)  # any eta >= 0 is valid, this one the best
    free, rise_free = c + left, slope_q * width_q
    more = eta * (c - speed * gap)  # what eta adds at the start of q, and at its end
    rise_more = eta * (slope_q + speed) * width_q
    if more < 0.0:
        # A kink inside q: of the lines between the two, the one that falls short of both equally at the ends.
        weight = (more + rise_more) / rise_more if more + rise_more > 0.0 else 0.0
        weight = min(weight, speed * (width_q + width_r) / -more)  # no more than can be flown within both
        more, rise_more = weight * more, weight * rise_more
    return free + more, free + more + rise_free + rise_more


@inlined
def after_leg(c, slope_q, slope_r, left, right, width_q, width_r, gap, speed, start, share):
    """Return (left, right) at the ends of r of: a value (left, right) at q, then the leg from q to r.

    start: time since the start of q before which the agent cannot leave; share: the part of r, from 0 to 1, that passes
    before it can arrive. Both only help to choose the better of two valid bounds.
    """
    price = (right - left) / width_q if width_q > 0.0 else -slope_q
    rise = price + slope_q
    if rise >= 0.0:  # best as soon as it can leave
        value = c + left + rise * start
        return value, value + slope_r * width_r
    free = c + left + rise * width_q
    rise_free = slope_r * width_r
    eta = min(-rise / (slope_q + speed), _LARGEST)
    held = left + (1.0 + eta) * c - eta * speed * gap
    rise_held = ((1.0 + eta) * slope_r - eta * speed) * width_r
    middle = 0.5 * (1.0 + share)
    if held + rise_held * middle > free + rise_free * middle:
        return held, held + rise_held
    return free, free + rise_free


@inlined
def share_before(time, start, width):
    """Return the part of a piece, from 0 to 1, that lies before `time`."""
    return max(0.0, time - start) / width if width > 0.0 else 0.0


@inlined
def least(left, right, share):
    """Return the least value of an affine function from `share` of its piece to the end."""
    return min(left + (right - left) * share, right)
