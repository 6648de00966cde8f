"""Hostile instances of at most five targets: on every path of the search what enumeration finds is found and proved."""

import math

import pytest

from mamttsp.exact import Parameters, solve_exact
from mamttsp.options import Options
from mamttsp.warm_up import ensure_compiled
from tests.exact.certificates import assert_brackets, assert_certificate
from tests.exact.hostile import KINDS, hostile
from tests.exact.paths import FORCED, GIVEN_UP, UNENUMERATED, UNSETTLED
from tests.oracle import optimum

PATHS = {"as it is": {}} | FORCED
#: s for the paths that may leave a gap
_LIMITS = dict.fromkeys((*UNENUMERATED, *GIVEN_UP), 5.0) | dict.fromkeys(UNSETTLED, 1.0)
#: instances of each kind: 210 in all, and 2025
FEW, MANY = range(14), range(1000, 1135)


@pytest.fixture(scope="module", autouse=True)
def compiled():
    """Compiling is no part of a time limit."""
    ensure_compiled()


def _assert_found(problem, expected, path):
    """Solve on a path; the optimum is proved, or that there is none. A path that leaves something out may leave a gap,
    if its bound and its tours hold."""
    limit = _LIMITS.get(path, 60.0)
    solution = solve_exact(problem, Options(time_limit=limit), Parameters(**PATHS[path]))
    if path in _LIMITS and solution.status in ("feasible", "unknown"):
        assert math.isfinite(expected) or not solution.tours
        assert_brackets(problem, solution, expected)
    else:
        assert_certificate(problem, solution, expected)


def _path(kind, seed):
    """Return a path, another one for each kind and seed, so that all paths meet all kinds."""
    return list(PATHS)[(list(KINDS).index(kind) + seed) % len(PATHS)]


@pytest.mark.parametrize("seed", FEW)
@pytest.mark.parametrize("kind", KINDS)
def test_one_path_leads_to_what_enumeration_finds(kind, seed):
    problem = hostile(kind, seed, most=4)
    _assert_found(problem, optimum(problem), _path(kind, seed))


def test_an_optimum_of_thousandths_is_proved_in_an_area_of_hundreds():
    problem = hostile("magnitudes", 1066)
    assert_certificate(problem, solve_exact(problem, Options(time_limit=60.0)), optimum(problem))


def test_an_enumeration_is_tried_after_hardly_any_work():
    problem = hostile("all_at_once", 1133)
    _assert_found(problem, math.inf, "two steps of column generation")


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", MANY)
def test_two_paths_lead_to_what_enumeration_finds(kind, seed):
    problem = hostile(kind, seed)
    expected = optimum(problem)
    for path in {"as it is", _path(kind, seed)}:
        _assert_found(problem, expected, path)
