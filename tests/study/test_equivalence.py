"""Tours and cycles in all three formulations at once."""

import dataclasses

import pytest

from mamttsp import Tour, Visit, build_graph
from mamttsp.formulations.equations import EQUATIONS
from mamttsp.study.equivalence import carry
from mamttsp.study.meetings import passing

HOME = Tour((Visit(0, 2.5, (10.0, 0.0)),), 5.0)


def cycle_at(instance, t):
    return tuple(Visit(u, t, tuple(instance.targets[u].position(t))) for u in (1, 2))


@pytest.mark.parametrize("m", [1, 2])
def test_targets_that_meet_make_a_cycle_that_violates_nothing(m):
    points = carry(build_graph(passing()), m, [HOME], [cycle_at(passing(), 50.0)])
    assert list(points) == list(EQUATIONS)
    for point in points.values():
        assert point.worst < 1e-9 and point.objective == pytest.approx(20.0)


def test_targets_that_miss_each_other_make_a_cycle_that_is_too_fast():
    near = passing(0.5)
    for point in carry(build_graph(near), 1, [HOME], [cycle_at(near, 50.0)]).values():
        assert point.worst == point.residuals["speed"] == pytest.approx(0.5)
        assert sorted(point.residuals.values())[-2] < 1e-9


def test_without_tours_only_the_micp_complains():
    """Nobody flies, and a cycle takes all targets: (20) is violated, (2) and (3) are not."""
    meeting = passing()
    pair = dataclasses.replace(meeting, targets=meeting.targets[1:])
    cycle = tuple(dataclasses.replace(visit, target=visit.target - 1) for visit in cycle_at(meeting, 50.0))
    points = carry(build_graph(pair), 1, [], [cycle])
    assert points["baseline"].worst < 1e-9 and points["nonconvex"].worst < 1e-9
    assert {family for family, r in points["micp"].residuals.items() if r > 1e-9} == {"number_of_agents"}
