"""Random instances by the paper's recipe (Section V-A), with every choice that it leaves open as a parameter.

The authors' own instances are not published: those made here are ours.
"""

import math
from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike

from .agents import Agents
from .instance import Instance, Target
from .validation import InputError, array, is_number, listed, positive, whole

PAPER_SIZES = (5, 10, 15, 20)
PAPER_INDICES = range(20)
#: changes whenever the same arguments come to give another instance
GENERATOR_VERSION = 1
_BATCH = 4096
_DIGITS = 9


def generate(
    n_targets: int,
    total_window: float,
    n_agents: int = 1,
    seed: int = 0,
    *,
    agents: Iterable[Agents] | None = None,
    demands: ArrayLike = 0.0,
    side: float = 100.0,
    horizon: float = 150.0,
    max_speed: float = 4.0,
    target_speed: tuple[float, float] = (0.5, 1.0),
    n_pieces: int = 4,
    nearest: int | None = None,
    widest_total_window: float = 60.0,
    max_tries: int = 10_000_000,
) -> Instance:
    """Return a random Instance by the recipe of Section V-A; the defaults are the paper's values.

    n_targets: n; total_window: total length in s of the two equal windows of each target; n_agents: m; seed: any whole
    number. The same (n_targets, seed) gives the same trajectories for every total_window and n_agents.
    agents: a list of Agents instead of n_agents and max_speed; demands: one number for all targets, or n of them. The
    windows then hold a tour that one agent of the first type can fly, whatever its capacity.
    side: S, the square is centred at (0, 0), the depot unless agents say otherwise; horizon: T in s; max_speed: v_max;
    target_speed: the range from which each target's constant speed is drawn, in units/s.

    From n_pieces on, arguments are what the paper leaves open, chosen here.
    n_pieces: straight pieces of each trajectory; their durations are drawn between once and twice a common
    length, headings uniformly among those that stay inside the square.
    nearest: the tour that the windows come from goes on to a random one of so many targets, those that it can meet
    first, so that windows crowd early; None: to any target.
    widest_total_window: windows are nested for every total_window up to this one, so that longer windows contain the
    shorter ones; the first contains the visit time of a random single-agent tour flown at v_max, at a random place in
    it, and the second lies anywhere clear of the widest first one.
    max_tries: how many random orders are tried for that tour before InputError.

    The instance's R is the diagonal of the square, as in the paper.

    >>> from mamttsp import generate
    >>> instance = generate(n_targets=5, total_window=40, n_agents=2, seed=7)
    >>> instance.n_targets, instance.n_agents, len(instance.targets[0].windows)
    (5, 2, 2)
    >>> instance == generate(n_targets=5, total_window=40, n_agents=2, seed=7)
    True
    """
    for name, count in (("n_targets", n_targets), ("n_pieces", n_pieces), ("max_tries", max_tries)):
        whole(name, count, 1)
    among = n_targets if nearest is None else whole("nearest", nearest, 1)
    whole("seed", seed, 0)
    for name, value in (("side", side), ("horizon", horizon), ("max_speed", max_speed)):
        positive(name, value)
    fleet = _agents(agents, n_agents, max_speed)
    _check_windows(total_window, widest_total_window, horizon)
    _check_target_speed(target_speed, min(entry.max_speed for entry in fleet))
    # One stream for each part, so that none depends on how much another draws.
    path_rng, tour_rng, window_rng = np.random.default_rng([n_targets, seed]).spawn(3)
    paths = [_trajectory(path_rng, side, horizon, target_speed, n_pieces) for _ in range(n_targets)]
    visits = _random_tour(tour_rng, paths, horizon, fleet[0], among, max_tries)
    targets = [
        Target(times, points, _windows(window_rng, visit, total_window / 2, widest_total_window / 2, horizon), demand)
        for (times, points), visit, demand in zip(paths, visits, _demands(demands, n_targets))
    ]
    places = np.concatenate([(entry.depot, entry.end) for entry in fleet])
    R = math.sqrt(2) * side if np.abs(places).max() <= side / 2 else None
    return Instance(targets, agents=fleet, horizon=horizon, R=R)


def paper_instance(n: int, index: int, total_window: float = 40, n_agents: int = 1) -> Instance:
    """Return one of our 80 instances by the paper's recipe: n in 5, 10, 15, 20 targets, index 0 to 19.

    >>> from mamttsp import paper_instance
    >>> instance = paper_instance(10, 3, total_window=20)
    >>> instance.n_targets, instance.max_speed, instance.horizon
    (10, 4.0, 150.0)
    """
    if n not in PAPER_SIZES:
        raise InputError(f"n: expected one of {PAPER_SIZES}, found {n!r}")
    if index not in PAPER_INDICES:
        raise InputError(f"index: expected a whole number from 0 to {PAPER_INDICES[-1]}, found {index!r}")
    return generate(n, total_window, n_agents, seed=index)


def _agents(agents, n_agents, max_speed):
    if agents is None:
        return [Agents(whole("n_agents", n_agents, 1), (0.0, 0.0), max_speed)]
    if (n_agents, max_speed) != (1, 4.0):
        raise InputError("agents: give either agents or n_agents and max_speed")
    agents = listed("agents", agents, Agents)
    if not agents:
        raise InputError("agents: expected at least one entry")
    return agents


def _demands(demands, n_targets):
    if is_number(demands):
        return [demands] * n_targets
    return array("demands", demands, (n_targets,)).tolist()


def _check_windows(total_window, widest, horizon):
    if positive("widest_total_window", widest) > horizon * 2 / 3:
        most = horizon * 2 / 3
        raise InputError(f"widest_total_window: expected at most two thirds of the horizon, {most:g}, found {widest:g}")
    if positive("total_window", total_window) > widest:
        raise InputError(f"total_window: expected at most widest_total_window {widest:g}, found {total_window:g}")


def _check_target_speed(target_speed, max_speed):
    slowest, fastest = array("target_speed", target_speed, (2,))
    if not 0 <= slowest <= fastest < max_speed:
        raise InputError(
            f"target_speed: expected 0 <= slowest <= fastest < max_speed {max_speed:g}, "
            f"found ({slowest:g}, {fastest:g})"
        )


def _trajectory(rng, side, horizon, target_speed, n_pieces):
    """Draw breakpoint times (n_pieces + 1,) and points inside the square, at one constant speed."""
    speed = rng.uniform(*target_speed)
    durations = rng.uniform(1.0, 2.0, n_pieces)
    times = np.concatenate([[0.0], np.cumsum(durations)]) * (horizon / durations.sum())
    times[-1] = horizon
    points = [rng.uniform(-side / 2, side / 2, 2)]
    for step in np.diff(times) * speed:
        points.append(_next_point(rng, points[-1], step, side))
    return np.round(times, _DIGITS), np.round(points, _DIGITS)


def _next_point(rng, point, step, side):
    """Draw a point `step` away in a uniform heading, among the headings that end inside the square.

    From anywhere in the square some corner is at least 0.7 side away, so a step of up to 0.65 side always has room.
    """
    if step > 0.65 * side:
        raise InputError(
            f"n_pieces: a straight piece of {step:g} units may not fit the square of side {side:g}; use more pieces"
        )
    while True:
        heading = rng.uniform(0.0, 2 * np.pi)
        candidate = point + step * np.array([np.cos(heading), np.sin(heading)])
        if np.abs(candidate).max() <= side / 2:
            return candidate


def _random_tour(rng, paths, horizon, entry, nearest, max_tries):
    """Return the visit time of each target in the first random order that one agent can fly at v_max within T.

    entry: the Agents that it is one of; nearest: among how many targets, those met first, each next one is drawn.
    """
    from .random_order import first_flyable, first_flyable_near  # here, because numba takes its time to import

    times = np.array([path[0] for path in paths])
    points = np.array([path[1] for path in paths])
    agent = entry.depot, entry.end, entry.max_speed
    for start in range(0, max_tries, _BATCH):
        draws = rng.random((min(_BATCH, max_tries - start), len(paths)))
        if nearest < len(paths):
            found, visits = first_flyable_near(draws, times, points, *agent, horizon, nearest)
        else:
            found, visits = first_flyable(draws, times, points, *agent, horizon)
        if found:
            return visits
    raise InputError(
        f"horizon: none of {max_tries} random orders of {len(paths)} targets "
        f"can be flown by one agent in {horizon:g} s; "
        "raise the horizon, or have fewer targets"
    )


def _windows(rng, visit, length, widest, horizon):
    """Return two disjoint windows (2, 2) of `length` in order of time, the first drawn one holding `visit`."""
    before, clear, shift = rng.uniform(size=3)
    main = np.clip(visit - before * length, 0.0, horizon - length)
    main_widest = np.clip(visit - before * widest, 0.0, horizon - widest)
    # The other window's widest form starts anywhere in the two stretches that the widest main window leaves free.
    left = max(main_widest - widest, 0.0)
    right = max(horizon - main_widest - 2 * widest, 0.0)
    other = clear * (left + right)
    if other > left:
        other += main_widest + widest - left
    other += shift * (widest - length)
    starts = np.sort([main, other])
    return np.round(np.stack([starts, starts + length], axis=1), _DIGITS)
