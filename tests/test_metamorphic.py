"""What a change of the instance must do to the optimum, whatever the optimum is."""

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mamttsp import Instance, Target, generate, solve
from tests.examples import HORIZON, MAX_SPEED, instance, still

METHODS = ("exact", "micp")
instances = st.builds(generate, st.integers(2, 4), st.sampled_from((20, 40)), st.integers(1, 3), st.integers(0, 10_000))
angles = st.floats(0, 2 * math.pi)
shifts = st.floats(-100, 100)
scales = st.floats(0.1, 10)


def _optimum(original, method):
    solution = solve(original, method=method)
    assert solution.status in ("optimal", "infeasible")
    return math.inf if solution.objective is None else solution.objective


def _mapped(original, to_place, time_scale=1.0, speed_scale=1.0):
    """Return the instance with every place mapped, and times and the agents' speed scaled."""
    targets = [Target(t.times * time_scale, to_place(t.points), t.windows * time_scale) for t in original.targets]
    return Instance(
        targets,
        original.n_agents,
        to_place(original.depot),
        original.max_speed * speed_scale,
        original.horizon * time_scale,
    )


def _with_windows(original, windows_of):
    targets = [dataclasses.replace(target, windows=windows_of(target)) for target in original.targets]
    return dataclasses.replace(original, targets=targets)


def _grown(windows, by, horizon):
    """Return the windows made longer at both ends, merged where they come to overlap."""
    grown = []
    for start, end in windows:
        start, end = max(start - by, 0.0), min(end + by, horizon)
        if grown and start <= grown[-1][1]:
            start, _ = grown.pop()
        grown.append((start, end))
    return grown


@pytest.mark.parametrize("method", METHODS)
@given(original=instances, angle=angles, x=shifts, y=shifts, mirrored=st.booleans())
def test_rotating_moving_and_mirroring_leave_the_optimum(method, original, angle, x, y, mirrored):
    turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    flip = np.diag([1.0, -1.0 if mirrored else 1.0])
    moved = _mapped(original, lambda places: places @ flip @ turn + (x, y))
    assert _optimum(moved, method) == pytest.approx(_optimum(original, method), rel=1e-4)


@pytest.mark.parametrize("method", METHODS)
@given(original=instances, space=scales, time=scales)
def test_scaling_space_and_speed_scales_the_optimum(method, original, space, time):
    scaled = _mapped(original, lambda places: places * space, time, space / time)
    assert _optimum(scaled, method) == pytest.approx(space * _optimum(original, method), rel=1e-4)


@pytest.mark.parametrize("method", METHODS)
@given(original=instances, by=st.floats(0, 20))
def test_longer_windows_never_raise_the_optimum(method, original, by):
    longer = _with_windows(original, lambda target: _grown(target.windows, by, original.horizon))
    assert _optimum(longer, method) <= _optimum(original, method) * (1 + 1e-4)


@pytest.mark.parametrize("method", METHODS)
@given(original=instances, more=st.integers(1, 2))
def test_more_agents_never_raise_the_optimum(method, original, more):
    assert _optimum(original.with_agents(original.n_agents + more), method) <= _optimum(original, method) * (1 + 1e-4)


@pytest.mark.parametrize("method", METHODS)
@given(original=instances, data=st.data())
def test_the_targets_order_in_the_file_changes_nothing(method, original, data):
    permuted = dataclasses.replace(original, targets=data.draw(st.permutations(original.targets)))
    assert _optimum(permuted, method) == pytest.approx(_optimum(original, method), rel=1e-4)


# --- Stationary targets: the travelling salesman with time windows ---------------------------------------------------

places = st.tuples(st.integers(-30, 30), st.integers(-30, 30))
starts = st.tuples(st.integers(0, 40), st.integers(50, 80))


def _salesman(targets, n_agents):
    """Return the least total length by trying every order, with as many returns to the depot as there are agents.

    targets: (place, windows) each. Waiting is free and lengths do not depend on time, so being early is best.
    """

    def best(rest, here, now, agents):
        way_home = math.dist(here, (0, 0))
        least = math.inf
        if now + way_home / MAX_SPEED <= HORIZON:
            if not rest:
                least = way_home
            elif agents and here != (0, 0):
                least = way_home + best(rest, (0, 0), 0.0, agents - 1)
        for target in rest:
            place, windows = target
            arrival = now + math.dist(here, place) / MAX_SPEED
            visit = min((max(arrival, start) for start, end in windows if arrival <= end), default=None)
            if visit is not None:
                least = min(least, math.dist(here, place) + best(rest - {target}, place, visit, agents))
        return least

    return best(frozenset(targets), (0, 0), 0.0, n_agents - 1)


@pytest.mark.parametrize("method", METHODS)
@given(
    where=st.lists(places.filter(any), min_size=2, max_size=4, unique=True),
    when=st.lists(starts, min_size=4, max_size=4),
    n_agents=st.integers(1, 3),
)
def test_stationary_targets_are_a_travelling_salesman_with_time_windows(method, where, when, n_agents):
    windows = [((a, a + 7.03125), (b, b + 5.015625)) for a, b in when]
    targets = list(zip(where, windows))
    solved = instance(*(still(*place, pair) for place, pair in targets), n_agents=n_agents)
    expected = _salesman(targets, n_agents)
    assert _optimum(solved, method) == (math.inf if math.isinf(expected) else pytest.approx(expected, rel=1e-4))


def test_the_salesman_by_hand():
    always, corners = ((0, 100),), [(0, 10), (10, 10), (10, 0)]
    assert _salesman([(corner, always) for corner in corners], 1) == pytest.approx(40.0)
    early = ((5, 6),)
    assert _salesman([((10, 0), early), ((-10, 0), early)], 1) == math.inf
    assert _salesman([((10, 0), early), ((-10, 0), early)], 2) == pytest.approx(40.0)
