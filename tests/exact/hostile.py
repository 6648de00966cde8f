"""Hostile instances of two to five targets: whatever makes bounds kinked, orders tied, times short or numbers large.

A kind is a function of a random generator and n, and returns n targets within `HORIZON`; `hostile` adds agents, alike
or of several types with capacities, and units from millimetres and milliseconds to thousands of kilometres and hours.
"""

import numpy as np

from mamttsp import Agents, Instance, Target
from mamttsp.motion import travel_time
from tests.examples import HORIZON, MAX_SPEED, moving, still

#: of a target that is nearly as fast as the agents, its share of their speed
_SHARES = (0.99, 0.9999, 1 - 1e-6, 1 - 1e-9)


def hostile(kind, seed, most=5):
    """Return the instance of a kind (a key of KINDS) with 2 to `most` targets."""
    rng = np.random.default_rng([list(KINDS).index(kind), seed])
    targets = KINDS[kind](rng, int(rng.integers(2, most + 1)))
    plain = rng.random() < 0.6
    agents = [Agents(int(rng.integers(1, 4)), (0.0, 0.0), MAX_SPEED)] if plain else _types(rng, targets)
    if not plain:
        targets = [Target(t.times, t.points, t.windows, demand) for t, demand in zip(targets, _demands(rng, targets))]
        agents = [_loaded(rng, entry, [target.demand for target in targets]) for entry in agents]
    if rng.random() < 0.5:
        return Instance(targets, agents=agents, horizon=HORIZON)
    return scaled(targets, agents, 10.0 ** rng.integers(-3, 7), rng.choice([1e-3, 1.0, 3600.0]))


def scaled(targets, agents, space, time):
    """Return the instance in other units: lengths times `space`, times times `time`."""
    targets = [Target(t.times * time, t.points * space, t.windows * time, t.demand) for t in targets]
    entries = [Agents(e.count, e.depot * space, e.max_speed * space / time, e.end * space, e.capacity) for e in agents]
    return Instance(targets, agents=entries, horizon=HORIZON * time)


def _types(rng, targets):
    """Return one to three types of agents, with depots and ends at the origin, at a target's place or anywhere."""

    def place():
        where = rng.integers(3)
        return ((0.0, 0.0), targets[0].points[0] if len(targets) else (0.0, 0.0), rng.integers(-30, 31, 2))[where]

    types = []
    for _ in range(rng.integers(1, 4)):
        depot, speed = place(), MAX_SPEED * rng.choice([1.0, 1.0 + 1e-6, 1.7])
        types.append(Agents(int(rng.integers(1, 3)), depot, speed, place() if rng.random() < 0.4 else None))
    return types


def _demands(rng, targets):
    """Return demands that sums of floating-point numbers may miss by their last bit, or whole ones, some of them 0."""
    return 0.1 * rng.integers(1, 4, len(targets)) if rng.random() < 0.5 else rng.integers(0, 4, len(targets))


def _loaded(rng, entry, demands):
    """Return the agents with no capacity, or one that some targets fill to the last bit."""
    some = [demand for demand in demands if rng.random() < 0.6]
    return Agents(entry.count, entry.depot, entry.max_speed, entry.end, None if rng.random() < 0.4 else sum(some))


# --- Kinds of targets --------------------------------------------------------------------------------------------


def _window(rng, longest=40.0):
    start = rng.uniform(0.0, 70.0)
    return start, min(start + rng.uniform(5.0, longest), HORIZON)


def _place(rng, side=30.0):
    return rng.uniform(-side, side, 2)


def _velocity(rng, fastest=1.0):
    angle = rng.uniform(0.0, 2 * np.pi)
    return rng.uniform(0.1, fastest) * np.array([np.cos(angle), np.sin(angle)])


def _through(place, moment, velocity, windows):
    return moving(np.subtract(place, moment * np.asarray(velocity)), velocity, windows)


def meeting(rng, n):
    """All but perhaps one pass one place at one moment, or miss it by little."""
    place, moment, miss = _place(rng), rng.uniform(20.0, 80.0), rng.choice([0.0, 1e-9, 1e-4, 1e-2])
    window = [(moment - rng.uniform(0.0, 15.0), moment + rng.uniform(0.0, 15.0))]
    targets = [_through(place + miss * rng.uniform(-1, 1, 2), moment, _velocity(rng, 2.0), window) for _ in range(n)]
    return targets if rng.random() < 0.5 else [*targets[1:], still(*_place(rng), [_window(rng)])]


def equal(rng, n):
    """One or two paths for all, with the same windows or with windows of their own."""
    paths = [(_place(rng), _velocity(rng)) for _ in range(rng.integers(1, 3))]
    common = [_window(rng)] if rng.random() < 0.5 else None
    return [moving(*paths[k % len(paths)], common or [_window(rng)]) for k in range(n)]


def stationary(rng, n):
    """Parked on few places, so that some are in the same one."""
    places = [_place(rng) for _ in range(rng.integers(1, n + 1))]
    return [still(*places[rng.integers(len(places))], [_window(rng)]) for _ in range(n)]


def moments(rng, n):
    """Windows of length zero."""
    return [
        moving(_place(rng), _velocity(rng), [(t, t) for t in sorted(rng.uniform(5.0, 95.0, rng.integers(1, 4)))])
        for _ in range(n)
    ]


def touching(rng, n):
    """Windows that touch, some of them of length zero between two others."""
    targets = []
    for _ in range(n):
        points = np.sort(rng.uniform(0.0, HORIZON, rng.integers(3, 5)))
        points = np.sort(np.r_[points, points[1:2]]) if rng.random() < 0.5 else points
        targets.append(moving(_place(rng), _velocity(rng), list(zip(points[:-1], points[1:]))))
    return targets


def whole_horizon(rng, n):
    """To be visited at any time."""
    return [moving(_place(rng, 20.0), _velocity(rng, 0.8)) for _ in range(n)]


def over_the_depot(rng, n):
    """At the depot, or through it."""
    targets = []
    for _ in range(n):
        window = _window(rng)
        moment = rng.uniform(*window)
        velocity = _velocity(rng, 2.0) if rng.random() < 0.7 else np.zeros(2)
        targets.append(_through((0.0, 0.0), moment, velocity, [window]))
    return targets


def nearly_as_fast(rng, n):
    """Some fly nearly as fast as agents can: towards the depot, away from it or past it."""
    targets = []
    for _ in range(n):
        heading = rng.normal(size=2)
        velocity = MAX_SPEED * rng.choice([*_SHARES, 0.2]) * heading / np.linalg.norm(heading)
        window = _window(rng)
        targets.append(_through(_place(rng), rng.uniform(*window), velocity, [window]))
    return targets


def on_a_grid(rng, n):
    """Whole coordinates, times and few headings: ties, paths side by side, flights that take the very time there is."""
    headings = np.array([(0, 0), (1, 0), (0, 1), (-1, 0), (0, -1)])
    targets = []
    for _ in range(n):
        start = 10.0 * rng.integers(0, 8)
        window = start, min(start + 10.0 * rng.integers(0, 5), HORIZON)
        targets.append(moving(rng.integers(-3, 4, 2) * 10, headings[rng.integers(5)], [window]))
    return targets


def bent(rng, n):
    """Paths with bends, some within windows and some where they begin or end, and long stops."""
    targets = []
    for _ in range(n):
        first, second = (_window(rng, 30.0), None) if rng.random() < 0.5 else ((10.0, 30.0), (30.0, 60.0))
        times = np.unique(np.r_[0.0, np.round(rng.uniform(1.0, 99.0, 2)), rng.choice([*first, 50.0]), HORIZON])
        steps = np.diff(times)[:, None] * [rng.choice([0.0, 1.0]) * _velocity(rng) for _ in times[1:]]
        points = _place(rng, 20.0) + np.vstack([np.zeros(2), np.cumsum(steps, axis=0)])
        targets.append(Target(times, points, [first] if second is None else [first, second]))
    return targets


def magnitudes(rng, n):
    """From thousandths of a unit to as far as agents get, and windows from thousandths of a second to all."""
    targets = []
    for _ in range(n):
        start, length = rng.uniform(30.0, 70.0), 10.0 ** rng.uniform(-3.0, 1.5)
        place, slow = 10.0 ** rng.uniform(-3.0, 1.8) * _velocity(rng), 10.0 ** rng.uniform(-6.0, 0.0)
        targets.append(_through(place, start, slow * _velocity(rng), [(start, min(start + length, HORIZON))]))
    return targets


def just_in_time(rng, n):
    """Each window ends when an agent at v_max that served the others in this order can first be there."""
    here, now, targets = np.zeros(2), 0.0, []
    for _ in range(n):
        start, velocity = here + _place(rng, 8.0), _velocity(rng)
        now += travel_time(*(start - here), *velocity, MAX_SPEED)
        here = start + velocity * travel_time(*(start - here), *velocity, MAX_SPEED)
        targets.append(_through(here, now, velocity, [(max(0.0, now - rng.choice([0.0, 1e-3, 5.0])), now)]))
    return targets


def all_at_once(rng, n):
    """One short window for all: too few agents cannot be in all places."""
    start = rng.uniform(10.0, 80.0)
    window = [(start, start + rng.choice([0.0, 1.0, 10.0]))]
    return [_through(_place(rng, 15.0), start, _velocity(rng), window) for _ in range(n)]


def many_windows(rng, n):
    """Three windows for each, so that a target has more segments than there are visits."""
    targets = []
    for _ in range(n):
        ends = np.sort(rng.uniform(0.0, HORIZON, 6))
        targets.append(moving(_place(rng), _velocity(rng), ends.reshape(3, 2)))
    return targets


def mixed(rng, n):
    """Each of another kind."""
    others = [kind for kind in KINDS.values() if kind is not mixed]
    return [others[rng.integers(len(others))](rng, n)[0] for _ in range(n)]


KINDS = {
    kind.__name__: kind
    for kind in (
        meeting, equal, stationary, moments, touching, whole_horizon, over_the_depot, nearly_as_fast, on_a_grid, bent,
        magnitudes, just_in_time, all_at_once, many_windows, mixed,
    )
}  # fmt: skip
