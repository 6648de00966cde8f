"""Stationary targets with one window each are a vehicle routing problem, solved by PyVRP in whole numbers.

Every flying time is rounded up and every window inward, so what PyVRP finds can be flown; its tours are then measured
in floating point by `check`, and its own rounded lengths are used for nothing.
"""

import math

import numpy as np
from pyvrp import Model
from pyvrp.stop import MaxRuntime

from mamttsp import Instance, Target, Visit, check
from mamttsp.tours import Tour

_UNIT = 10_000  # parts of a second, and of a unit of length
SIDE, MAX_SPEED = 100.0, 4.0


def customers(n, n_agents, window, seed, horizon=150.0):
    """Return an instance of n stationary targets in the paper's square, with windows that hold a division into tours.

    Targets are dealt out at random and flown to in the order of their angles; each window contains its visit.
    """
    rng = np.random.default_rng([n, n_agents, seed])
    places = rng.uniform(-SIDE / 2, SIDE / 2, (n, 2)).round(3)
    agent = rng.permutation(n) % n_agents
    targets = [None] * n
    for k in range(n_agents):
        here, now = np.zeros(2), 0.0
        for u in sorted(np.flatnonzero(agent == k), key=lambda u: math.atan2(*places[u])):
            now += np.linalg.norm(places[u] - here) / MAX_SPEED
            here = places[u]
            start = min(max(now - rng.uniform(0.0, window), 0.0), horizon - window)
            targets[u] = Target([0.0, horizon], [here, here], [[start, start + window]])
    return Instance(targets, n_agents, (0.0, 0.0), MAX_SPEED, horizon)


def pyvrp_length(instance, seconds, seed=0):
    """Return the checked length of PyVRP's tours of an instance of stationary targets; inf if it finds none."""
    model = Model()
    places = np.vstack([instance.depot, *(target.points[:1] for target in instance.targets)])
    locations = [model.add_location(0, 0) for _ in range(1 + instance.n_targets)]
    end = math.floor(instance.horizon * _UNIT)
    depot = model.add_depot(locations[0], tw_late=end)
    for location, target in zip(locations[1:], instance.targets):
        ((early, late),) = target.windows
        model.add_client(location, tw_early=math.ceil(early * _UNIT), tw_late=math.floor(late * _UNIT))
    model.add_vehicle_type(instance.n_agents, start_depot=depot, end_depot=depot, tw_late=end)
    for i, tail in enumerate(locations):
        for j, head in enumerate(locations):
            length = float(np.linalg.norm(places[i] - places[j]))
            model.add_edge(tail, head, round(length * _UNIT), math.ceil(length / instance.max_speed * _UNIT))
    best = model.solve(MaxRuntime(seconds), seed=seed, display=False).best
    if not best.is_feasible():
        return math.inf
    return check(instance, [_tour(instance, _clients(route)) for route in best.routes()])


def _clients(route):
    return [activity.idx for activity in route.schedule() if activity.is_client()]


def _tour(instance, order):
    """Return the Tour that flies to the targets in order, each as early as can be."""
    here, now, visits = instance.depot, 0.0, []
    for u in order:
        place = instance.targets[u].points[0]
        now = max(now + math.dist(here, place) / instance.max_speed, instance.targets[u].windows[0, 0])
        visits.append(Visit(u, now, tuple(place)))
        here = place
    return Tour(tuple(visits), now + math.dist(here, instance.depot) / instance.max_speed)
