"""The hole in the paper's models, shown by the plain models themselves."""

import time

import pytest

from mamttsp import Instance, PaperSolution, TourError, check, formulations, generate, solve
from mamttsp.backends import Answer, Progress
from tests.meetings import passing
from tests.oracle import optimum

MODELS = [
    ("micp", "cvxpy", "highs"),
    ("micp", "cvxpy", "scip"),
    ("micp", "pyomo", "scip"),
    ("baseline", "cvxpy", "scip"),
    ("baseline", "pyomo", "scip"),
    ("nonconvex", "pyomo", "scip"),
]


@pytest.mark.parametrize("method, modeler, solver", MODELS)
def test_every_model_accepts_a_cycle_that_nobody_flies(method, modeler, solver):
    problem = passing(0.0)
    plain = solve(problem, method, modeler, solver, subtour_cuts=False)
    assert plain.status == "optimal" and plain.objective == pytest.approx(20.0, abs=1e-3)
    assert [sorted(cycle) for cycle in plain.cycles] == [[1, 2]] and plain.paths == ((0,),)
    assert plain.objective < 0.2 * optimum(problem)


def test_a_false_claim_comes_without_tours_and_fails_the_check(tmp_path):
    problem = passing(0.0)
    plain = solve(problem, "micp", subtour_cuts=False)
    assert plain.tours == ()
    with pytest.raises(TourError, match="target 1 is visited 0 times"):
        check(problem, plain.tours)
    plain.write(tmp_path / "claim.json")


@pytest.mark.parametrize("subtour_cuts", [True, False])
def test_the_time_limit_includes_the_building(monkeypatch, subtour_cuts):
    """Building takes 0.3 s: of 1 s the solver gets at most the rest, of 0.2 s nothing."""
    build, seen = formulations.build_formulation, []

    def slowly(*arguments):
        time.sleep(0.3)
        return build(*arguments)

    def run(formulation, options):
        seen.append(options.time_limit)
        options.progress(Progress(0.1, None, None, None, None, "script"))
        return Answer("unknown", None, None, None, None, 0.1, "script 1")

    monkeypatch.setattr("mamttsp.formulations.build_formulation", slowly)
    monkeypatch.setattr("mamttsp.backends.scip.solve", run)
    reports, how = [], {"method": "micp", "solver": "scip", "subtour_cuts": subtour_cuts}
    solve(generate(2, 20), time_limit=1.0, progress=reports.append, **how)
    assert 0.0 < seen.pop() <= 0.7 and reports[0].time >= 0.4
    late = solve(generate(2, 20), time_limit=0.2, **how)
    assert (late.status, late.solver, seen) == ("unknown", "scip", [])


@pytest.mark.parametrize("subtour_cuts", [True, False])
def test_ctrl_c_while_a_model_is_built_is_a_status(monkeypatch, subtour_cuts):
    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("mamttsp.formulations.pyomo.micp.build", interrupt)
    solution = solve(generate(2, 20), "micp", "pyomo", "scip", subtour_cuts=subtour_cuts)
    assert (solution.status, solution.tours, solution.bound) == ("unknown", (), None)
    assert isinstance(solution, PaperSolution) != subtour_cuts


def test_where_no_targets_meet_the_plain_model_tells_the_truth():
    problem = generate(3, 20, 2, seed=0)
    plain = solve(problem, "micp", subtour_cuts=False)
    assert plain.cycles == () and plain.objective == pytest.approx(optimum(problem), rel=1e-4)
    assert check(problem, plain.tours) == pytest.approx(plain.objective, rel=1e-4)


@pytest.mark.parametrize("method, modeler, solver", MODELS)
def test_where_all_targets_meet_all_agents_stay_at_home_unless_one_must_fly(method, modeler, solver):
    """Equation (20) asks for one agent at least, (2) and (3) do not: even the optimal values differ."""
    two = Instance(passing(0.0).targets[1:], 1, (0.0, 0.0), 4.0, 100.0)
    plain = solve(two, method, modeler, solver, subtour_cuts=False)
    cut = solve(two, method, modeler, solver)
    if method == "micp":
        assert plain.objective == pytest.approx(optimum(two), rel=1e-4) and plain.cycles == ()
    else:
        assert plain.objective == pytest.approx(0.0, abs=1e-3) and plain.paths == () and plain.tours == ()
        assert [sorted(cycle) for cycle in plain.cycles] == [[0, 1]] and cut.subtour_cuts == 1
    assert cut.status == "optimal" and cut.objective == pytest.approx(optimum(two), rel=1e-4)
