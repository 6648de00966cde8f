"""Small instances made by hand, for tests that need to know the answer."""

import numpy as np

from mamttsp import Instance, Target

HORIZON = 100.0
MAX_SPEED = 4.0
ALWAYS = ((0.0, HORIZON),)


def still(x, y, windows=ALWAYS):
    """Return a target that stays at (x, y)."""
    return Target([0.0, HORIZON], [[x, y], [x, y]], windows)


def moving(start, velocity, windows=ALWAYS):
    """Return a target on a straight line from `start`, with constant velocity."""
    end = np.add(start, HORIZON * np.asarray(velocity))
    return Target([0.0, HORIZON], [start, end], windows)


def instance(*targets, n_agents=1):
    """Return an instance of the targets, with the depot at the origin."""
    return Instance(targets, n_agents, (0.0, 0.0), MAX_SPEED, HORIZON)
