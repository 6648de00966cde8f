"""The outer approximation on HiGHS: tangents are valid, bounds and optima right."""

import time

import highspy
import numpy as np
import pytest

from mamttsp import build_graph, generate, solve
from mamttsp.backends import Options, highs
from mamttsp.backends.cone_cuts import ConeCuts
from mamttsp.formulations import build_formulation, graph_for
from tests.examples import instance, still
from tests.general_instances import random_general
from tests.meetings import passing
from tests.oracle import optimum


def _formulation(problem, method="micp"):
    return build_formulation(method, "cvxpy", build_graph(problem), problem.n_agents)


@pytest.fixture(scope="module")
def program():
    return _formulation(generate(3, 20, seed=0)).conic_program()


def _norms(cones, x):
    w = cones.b - (cones.A @ x).reshape(cones.b.shape)
    return w[:, 0], np.linalg.norm(w[:, 1:], axis=1)


def test_tangents_cut_off_the_point_they_were_made_at(program):
    cones = ConeCuts(program)
    x = np.random.default_rng(0).normal(size=len(program.c))
    heads, norms = _norms(cones, x)
    R, upper = cones.violated(x)
    assert len(upper) == (norms > heads).sum() > 0
    assert R @ x - upper == pytest.approx((norms - heads)[norms > heads])


def test_tangents_cut_off_no_point_of_the_cones(program):
    cones = ConeCuts(program)
    rng = np.random.default_rng(1)
    rows = [cones.first(), cones.violated(rng.normal(size=len(program.c)))]
    lengths = program.columns["l"]
    for point in rng.normal(size=(20, len(program.c))):
        heads, norms = _norms(cones, point)
        inside = point + _raise_heads(cones, heads, norms)
        assert len(lengths) and all((R @ inside <= upper + 1e-9).all() for R, upper in rows)


def _raise_heads(cones, heads, norms):
    """Return the change of x that lifts each cone's head to its norm; a head is a variable of its own here."""
    A = cones.A[cones.heads]
    return -A.T @ np.maximum(norms - heads, 0.0) / A.multiply(A).sum(axis=1).max()


@pytest.mark.parametrize("method", ["micp", "baseline"])
def test_the_optimum(method):
    problem = generate(3, 20, 2, seed=3)
    answer = highs.solve(_formulation(problem, method), Options())
    assert answer.status == "optimal" and answer.objective == pytest.approx(optimum(problem), rel=1e-4)
    assert answer.bound <= optimum(problem) * (1 + 1e-6)
    assert answer.solver == "highs " + ".".join(highspy.Highs().version().split(".")[:2])


def test_no_solution():
    nowhere = instance(still(10, 0, [(5, 6)]), still(-10, 0, [(5, 6)]))
    assert highs.solve(_formulation(nowhere), Options()).status == "infeasible"


def test_no_optimum_is_lost_to_presolve():
    """With its presolve, HiGHS 1.15 proves 145.28 here."""
    problem = random_general(3, 2, 28)
    answer = highs.solve(build_formulation("micp", "cvxpy", graph_for("micp", problem)), Options())
    assert answer.bound <= optimum(problem) * (1 + 1e-6)
    assert answer.objective == pytest.approx(optimum(problem), rel=1e-4)


@pytest.mark.parametrize("miss", [1e-9, 1e-8, 3e-7, 1e-6, 1e-5])
def test_targets_that_miss_by_about_its_tolerance_are_not_called_infeasible(miss):
    solution = solve(passing(miss), "micp", solver="highs")
    assert solution.objective == pytest.approx(optimum(passing(miss)), rel=1e-4)


def test_progress_and_a_limit():
    problem, reports = generate(10, 40, 1, seed=0), []
    answer = highs.solve(_formulation(problem), Options(time_limit=3.0, progress=reports.append))
    bounds = [report.bound for report in reports if report.bound is not None]
    assert reports and bounds == sorted(bounds)
    assert answer.bound == max(bounds, default=None)
    assert answer.bound is None or answer.bound <= solve(problem).objective
    assert answer.status == ("unknown" if answer.objective is None else "feasible")
    assert answer.objective == reports[-1].objective and (answer.flow is None) == (answer.status == "unknown")


@pytest.mark.parametrize("seconds", [1.0, 2.0])
def test_ctrl_c_in_a_run_of_highs_is_a_status(ctrl_c, capfd, seconds):
    formulation = _formulation(generate(10, 60, 1, seed=0))
    ctrl_c(seconds)
    start = time.perf_counter()
    answer = highs.solve(formulation, Options())
    assert answer.status in ("feasible", "unknown") and (answer.flow is None) == (answer.status == "unknown")
    assert time.perf_counter() - start < seconds + 20.0 and capfd.readouterr().out == ""


def test_ctrl_c_between_runs_of_highs_keeps_what_is_known():
    reports = []

    def interrupt(report):
        reports.append(report)
        raise KeyboardInterrupt

    answer = highs.solve(_formulation(generate(5, 40, 1, seed=0)), Options(gap=0.0, progress=interrupt))
    assert len(reports) == 1 and (answer.objective, answer.bound) == (reports[0].objective, reports[0].bound)
    assert answer.bound > 0.0 and answer.status == ("unknown" if answer.objective is None else "feasible")
