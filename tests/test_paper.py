"""The hole in the paper's models, shown by the plain models themselves."""

import pytest
from meetings import passing
from oracle import optimum

from mamttsp import TourError, check, generate, solve

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
