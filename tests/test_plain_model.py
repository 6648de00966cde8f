"""The hole in the paper's models, shown by the plain models themselves."""

import pytest
from meetings import passing
from oracle import optimum

from mamttsp import Instance, TourError, check, generate, solve

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
