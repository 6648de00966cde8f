"""What a change of types, capacities or demands must do to the optimum, whatever the optimum is."""

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mamttsp import Agents, Instance, Target, solve
from tests.general_instances import random_general

instances = st.builds(random_general, st.integers(2, 4), st.integers(1, 3), st.integers(0, 10_000))


every_method = pytest.mark.parametrize("method", ("exact", "micp"))


def _optimum(problem, method):
    solution = solve(problem, method=method)
    assert solution.status in ("optimal", "infeasible")
    return math.inf if solution.objective is None else solution.objective


def _one_changed(problem, k, **changes):
    """Return the instance with one type of agents changed."""
    k %= len(problem.agents)
    entries = list(problem.agents)
    entries[k] = dataclasses.replace(entries[k], **changes)
    return dataclasses.replace(problem, agents=entries)


def _same(a, b):
    return a == b or a == pytest.approx(b, rel=1e-4)


@every_method
@given(problem=instances, k=st.integers(0, 2), more=st.integers(1, 2))
def test_more_agents_of_a_type_never_raise_the_optimum(method, problem, k, more):
    count = problem.agents[k % len(problem.agents)].count + more
    assert _optimum(_one_changed(problem, k, count=count), method) <= _optimum(problem, method) * (1 + 1e-4)


@every_method
@given(problem=instances, k=st.integers(0, 2), more=st.one_of(st.none(), st.floats(0, 5)))
def test_more_capacity_never_raises_the_optimum(method, problem, k, more):
    capacity = problem.agents[k % len(problem.agents)].capacity
    capacity = None if None in (more, capacity) else capacity + more
    assert _optimum(_one_changed(problem, k, capacity=capacity), method) <= _optimum(problem, method) * (1 + 1e-4)


@every_method
@given(problem=instances, k=st.integers(0, 2), faster=st.floats(1, 3))
def test_more_speed_never_raises_the_optimum(method, problem, k, faster):
    speed = problem.agents[k % len(problem.agents)].max_speed * faster
    assert _optimum(_one_changed(problem, k, max_speed=speed), method) <= _optimum(problem, method) * (1 + 1e-4)


@every_method
@given(problem=instances, share=st.floats(0, 1))
def test_less_demand_never_raises_the_optimum(method, problem, share):
    lighter = [dataclasses.replace(target, demand=share * target.demand) for target in problem.targets]
    assert _optimum(dataclasses.replace(problem, targets=lighter), method) <= _optimum(problem, method) * (1 + 1e-4)


@every_method
@given(problem=instances, k=st.integers(0, 2))
def test_a_type_split_in_two_equal_ones_changes_nothing(method, problem, k):
    k %= len(problem.agents)
    doubled = _one_changed(problem, k, count=2)
    one = dataclasses.replace(problem.agents[k], count=1)
    split = dataclasses.replace(problem, agents=[*problem.agents[:k], one, one, *problem.agents[k + 1 :]])
    assert _same(_optimum(split, method), _optimum(doubled, method))


@every_method
@given(problem=instances, data=st.data())
def test_the_order_of_the_types_changes_nothing(method, problem, data):
    permuted = dataclasses.replace(problem, agents=data.draw(st.permutations(problem.agents)))
    assert _same(_optimum(permuted, method), _optimum(problem, method))


@every_method
@given(problem=instances, angle=st.floats(0, 2 * math.pi), x=st.floats(-100, 100), y=st.floats(-100, 100))
def test_depots_moved_with_everything_else_change_nothing(method, problem, angle, x, y):
    turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])

    def moved(place):
        return np.asarray(place) @ turn + (x, y)

    entries = [dataclasses.replace(entry, depot=moved(entry.depot), end=moved(entry.end)) for entry in problem.agents]
    targets = [Target(t.times, moved(t.points), t.windows, t.demand) for t in problem.targets]
    assert _same(
        _optimum(Instance(targets, agents=entries, horizon=problem.horizon), method), _optimum(problem, method)
    )


@every_method
@given(problem=instances, unit=st.floats(0.01, 1000))
def test_the_unit_of_demand_changes_nothing(method, problem, unit):
    entries = [
        dataclasses.replace(entry, capacity=None if entry.capacity is None else unit * entry.capacity)
        for entry in problem.agents
    ]
    targets = [dataclasses.replace(target, demand=unit * target.demand) for target in problem.targets]
    assert _same(
        _optimum(Instance(targets, agents=entries, horizon=problem.horizon), method), _optimum(problem, method)
    )


@every_method
@given(problem=instances)
def test_reversed_in_time_with_depots_and_ends_exchanged_nothing_changes(method, problem):
    """An agent may wait at its depot, and may be early at its end, so a tour flown backwards is a tour."""
    T = problem.horizon
    targets = [Target(T - t.times[::-1], t.points[::-1], T - t.windows[::-1, ::-1], t.demand) for t in problem.targets]
    entries = [Agents(e.count, e.end, e.max_speed, e.depot, e.capacity) for e in problem.agents]
    assert _same(_optimum(Instance(targets, agents=entries, horizon=T), method), _optimum(problem, method))


@every_method
@given(problem=instances)
def test_agents_that_no_target_needs_change_nothing(method, problem):
    """A type without capacity serves only what has no demand; where all have one it flies nothing."""
    heavy = [dataclasses.replace(target, demand=target.demand + 1.0) for target in problem.targets]
    idle = Agents(2, (0.0, 0.0), 9.0, capacity=0.0)
    entries = [problem.agents, [*problem.agents, idle]]
    with_it, without = (Instance(heavy, agents=own, horizon=problem.horizon) for own in entries)
    assert _same(_optimum(with_it, method), _optimum(without, method))
