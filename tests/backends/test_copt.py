"""COPT, where it is installed: its progress and Ctrl-C, within what it solves without a licence."""

import pytest

from mamttsp import build_graph, generate, solve
from mamttsp.backends import Options
from mamttsp.formulations import build_formulation

copt = pytest.importorskip("mamttsp.backends.copt", exc_type=ImportError)
PROBLEM = generate(5, 40, 1, seed=0)


def _solve(report):
    formulation = build_formulation("micp", "cvxpy", build_graph(PROBLEM, prune=True), 1)
    return copt.solve(formulation, Options(progress=report))


def test_progress_reports_incumbent_and_bound():
    reports = []
    answer = _solve(reports.append)
    bounds = [report.bound for report in reports]
    assert bounds == pytest.approx(sorted(bounds), rel=1e-6) and bounds[-1] <= answer.objective * (1 + 1e-6)
    assert reports[-1].objective == pytest.approx(solve(PROBLEM).objective, rel=1e-4)


def test_ctrl_c_returns_what_stands():
    def interrupt(report):
        raise KeyboardInterrupt

    answer = _solve(interrupt)
    assert answer.status == ("unknown" if answer.flow is None else "feasible")
    assert answer.bound <= solve(PROBLEM).objective * (1 + 1e-6)
