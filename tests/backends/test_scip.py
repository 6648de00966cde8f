"""SCIP: options reach it, limits and Ctrl-C are statuses, progress comes, and the cure for its wheel is always on."""

import signal

import pyscipopt
import pytest

from mamttsp import build_graph, generate, solve
from mamttsp.backends import Options, scip
from mamttsp.formulations import build_formulation
from tests.examples import instance, still
from tests.oracle import optimum

ROUTES = [("micp", "pyomo"), ("micp", "cvxpy"), ("baseline", "pyomo"), ("baseline", "cvxpy"), ("nonconvex", "pyomo")]


def _formulation(problem, method="micp", modeler="pyomo"):
    return build_formulation(method, modeler, build_graph(problem), problem.n_agents)


@pytest.fixture
def settings(monkeypatch):
    """Record every parameter that is set on a SCIP model."""
    seen = {}

    class Recorded(pyscipopt.Model):
        def setParam(self, name, value):
            seen[name] = value
            super().setParam(name, value)

    monkeypatch.setattr(pyscipopt, "Model", Recorded)
    return seen


@pytest.mark.parametrize("method, modeler", ROUTES)
def test_the_flow_is_the_optimums(method, modeler):
    problem = instance(still(10, 0), still(0, 10), n_agents=2)
    formulation = _formulation(problem, method, modeler)
    answer = scip.solve(formulation, Options())
    assert answer.status == "optimal" and answer.solver == f"scip {_version()}"
    assert answer.objective == pytest.approx(optimum(problem), rel=1e-4)
    assert answer.flow == pytest.approx(formulation.flow()) and answer.flow.sum() == pytest.approx(3.0)


def _version():
    model = pyscipopt.Model()
    return f"{model.getMajorVersion()}.{model.getMinorVersion()}"


@pytest.mark.parametrize("modeler", ["pyomo", "cvxpy"])
def test_the_options_reach_scip(modeler, settings):
    problem = instance(still(10, 0))
    scip.solve(_formulation(problem, modeler=modeler), Options(time_limit=30.0, gap=0.25, threads=2, seed=7))
    assert settings["limits/gap"] == 0.25 and settings["randomization/randomseedshift"] == 7
    assert settings["lp/threads"] == 2 and 0 < settings["limits/time"] <= 30.0


@pytest.mark.parametrize("modeler", ["pyomo", "cvxpy"])
def test_the_option_file_that_keeps_ipopt_alive_is_always_given(modeler, settings, monkeypatch):
    texts = []
    optimize = pyscipopt.Model.optimize

    def read_and_optimize(model):
        with open(settings["nlpi/ipopt/optfile"]) as file:
            texts.append(file.read())
        optimize(model)

    monkeypatch.setattr(pyscipopt.Model, "optimize", read_and_optimize)
    scip.solve(_formulation(instance(still(10, 0)), modeler=modeler), Options())
    assert texts == ["mumps_pivot_order 0\n"]


def test_verbosity(capfd):
    problem = instance(still(10, 0))
    scip.solve(_formulation(problem), Options())
    assert capfd.readouterr().out == ""
    scip.solve(_formulation(problem), Options(verbose=True))
    assert "SCIP Status" in capfd.readouterr().out


def test_progress_reports_incumbent_and_bound():
    reports = []
    scip.solve(_formulation(generate(3, 20, 1, seed=0), "baseline"), Options(progress=reports.append))
    assert reports and all(report.phase == "scip" for report in reports)
    assert [report.time for report in reports] == sorted(report.time for report in reports)
    known = [report for report in reports if report.gap is not None]
    assert known and all(report.bound <= report.objective * (1 + 1e-6) for report in known)


@pytest.mark.parametrize("stop", [lambda: signal.raise_signal(signal.SIGINT), lambda: _interrupt()])
def test_ctrl_c_returns_what_stands(stop):
    problem = generate(8, 60, 2, seed=0)
    answer = scip.solve(_formulation(problem, "baseline"), Options(progress=lambda report: stop()))
    assert answer.status in ("feasible", "unknown")
    assert (answer.flow is None) == (answer.status == "unknown")


def _interrupt():
    raise KeyboardInterrupt


def test_a_limit_ends_it_with_what_stands():
    problem = generate(10, 60, 3, seed=1)
    answer = scip.solve(_formulation(problem, "baseline", "cvxpy"), Options(time_limit=1.0))
    assert answer.status == ("unknown" if answer.flow is None else "feasible") and answer.runtime < 20.0
    assert (answer.objective is None) == (answer.flow is None)
    assert (answer.bound or 0.0) <= solve(problem).objective * (1 + 1e-6)


def test_stopped_before_any_incumbent_it_still_gives_the_bound():
    problem = generate(6, 40, 1, seed=1)

    def stop(report):
        if report.bound:
            raise KeyboardInterrupt

    answer = scip.solve(_formulation(problem, "micp", "cvxpy"), Options(progress=stop))
    assert 0.0 < answer.bound <= solve(problem).objective * (1 + 1e-6)
    assert answer.status == ("unknown" if answer.flow is None else "feasible")
