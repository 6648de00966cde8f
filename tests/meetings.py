"""Instances whose targets meet or nearly meet, where the paper's models accept cycles that nobody flies."""

import numpy as np

from tests.examples import instance, moving, still

MEETING = 50.0
WINDOW = ((45.0, 55.0),)
PLACE = np.array([60.0, 0.0])
NEAR = still(10, 0)


def through(place, velocity):
    """Return a target that is at `place` when the others meet."""
    return moving(place - MEETING * np.asarray(velocity), velocity, WINDOW)


def passing(miss):
    """Two targets that pass each other `miss` units apart far from the depot, and one that stays near it.

    The nearest target alone is a tour of 20; no tour that goes out to where the others meet is below 100.
    """
    return instance(NEAR, through(PLACE, (0.5, 0.3)), through(PLACE + (0.0, miss), (-0.4, 0.6)))


def three_at_one_point():
    """Like passing(0), with a third target through the same point."""
    return instance(NEAR, *(through(PLACE, velocity) for velocity in ((0.5, 0.3), (-0.4, 0.6), (0.0, -0.7))))


def two_on_one_path():
    """Two targets that are in the same place all the time."""
    return instance(NEAR, through(PLACE, (0.5, 0.3)), through(PLACE, (0.5, 0.3)))
