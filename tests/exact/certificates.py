"""What a Solution of the exact solver must say of an optimum that is known from elsewhere."""

import math

import pytest

from mamttsp import check, solve

#: relative error of lengths that come from an SOCP
_NOISE = 1e-7


def assert_sound(problem, solution):
    """Whenever and however a run ends, its tours can be flown and its bound does not pass their length."""
    assert solution.status in ("optimal", "feasible", "unknown")
    assert math.isfinite(solution.bound) and solution.bound >= 0.0
    if solution.status == "unknown":
        assert solution.objective is None and solution.tours == ()
    else:
        assert solution.objective == check(problem, solution.tours)
        assert solution.bound <= solution.objective


def assert_brackets(problem, solution, optimum):
    """The bound is at most the optimum, the objective at least."""
    assert_sound(problem, solution)
    assert solution.bound <= optimum + _NOISE * problem.size
    if solution.tours:
        assert solution.objective >= optimum - _NOISE * problem.size


def assert_certified(problem, optimum, gap=1e-4):
    """Solve; what comes out is the optimum, proved to within the gap, or the proof that there is none (infinity)."""
    assert_certificate(problem, solve(problem, gap=gap), optimum, gap)


def assert_certificate(problem, solution, optimum, gap=1e-4):
    """The solution is the optimum, proved to within the gap, or the proof that there is none (infinity)."""
    if math.isinf(optimum):
        assert solution.status == "infeasible" and solution.tours == ()
        assert solution.objective is None and solution.bound is None
        return
    assert_brackets(problem, solution, optimum)
    assert solution.status == "optimal"
    assert solution.objective - solution.bound <= max(gap * solution.objective, _NOISE * problem.size)
    assert solution.objective == pytest.approx(optimum, rel=gap, abs=_NOISE * problem.size)
