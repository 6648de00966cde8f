"""The log of a run: what the callback receives, and that it only ever gets better."""

import math

import pytest

from mamttsp import Progress, generate, paper_instance, solve
from tests.examples import instance, still

#: (n, total window, m, time limit)
RUNS = [(5, 40, 2, None), (10, 60, 1, None), (15, 40, 3, None), (20, 60, 2, 2.0)]


def _log(problem, **options):
    log = []
    return solve(problem, progress=log.append, **options), log


@pytest.mark.parametrize("n, window, m, limit", RUNS)
def test_every_report_is_complete_and_none_is_worse_than_the_one_before(n, window, m, limit):
    solution, log = _log(paper_instance(n, 3, window, m), time_limit=limit)
    assert log and all(isinstance(report, Progress) for report in log)
    for report in log:
        assert report.phase and report.nodes >= 0 and report.bound >= 0.0
        if report.objective is None:
            assert report.gap is None
        else:
            assert report.bound <= report.objective
            assert report.gap == pytest.approx((report.objective - report.bound) / report.objective)
    for before, after in zip(log[:-1], log[1:]):
        assert after.time >= before.time and after.bound >= before.bound and after.nodes >= before.nodes
        assert _length(after) <= _length(before)
    last = log[-1]
    assert solution.bound >= last.bound and solution.objective <= _length(last) * (1 + 1e-12)


def _length(report):
    return math.inf if report.objective is None else report.objective


def test_the_last_report_is_the_answer():
    solution, log = _log(generate(8, 40, 2, seed=1))
    assert log[-1].bound == solution.bound and log[-1].objective == pytest.approx(solution.objective, rel=1e-12)


def test_where_there_is_no_solution_no_report_has_one():
    solution, log = _log(instance(still(10, 0, [(5, 6)]), still(-10, 0, [(5, 6)])))
    assert solution.status == "infeasible"
    assert all(report.objective is None and report.gap is None for report in log)


def test_watching_changes_nothing():
    problem = generate(8, 40, 2, seed=4)
    watched, _ = _log(problem)
    alone = solve(problem)
    assert (watched.objective, watched.bound, watched.tours) == (alone.objective, alone.bound, alone.tours)
