"""Small instances made by hand, for tests that need to know the answer."""

import numpy as np

from mamttsp import Agents, Instance, Target

HORIZON = 100.0
MAX_SPEED = 4.0
ALWAYS = ((0.0, HORIZON),)


def still(x, y, windows=ALWAYS, demand=0.0):
    """Return a target that stays at (x, y)."""
    return Target([0.0, HORIZON], [[x, y], [x, y]], windows, demand)


def moving(start, velocity, windows=ALWAYS, demand=0.0):
    """Return a target on a straight line from `start`, with constant velocity."""
    end = np.add(start, HORIZON * np.asarray(velocity))
    return Target([0.0, HORIZON], [start, end], windows, demand)


def instance(*targets, n_agents=1):
    """Return an instance of the targets, with the depot at the origin."""
    return Instance(targets, n_agents, (0.0, 0.0), MAX_SPEED, HORIZON)


def agents(count=1, depot=(0.0, 0.0), max_speed=MAX_SPEED, end=None, capacity=None):
    """Return agents like those of `instance`, but for what is said."""
    return Agents(count, depot, max_speed, end, capacity)


def general(*targets, types):
    """Return an instance of the targets with these types of agents."""
    return Instance(targets, agents=types, horizon=HORIZON)
