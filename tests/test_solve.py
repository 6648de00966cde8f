"""The front door: choices, limits, and targets that meet."""

import pytest

from mamttsp import InputError, check, generate, solve
from tests.examples import instance, still
from tests.meetings import passing, three_at_one_point, two_on_one_path
from tests.oracle import optimum
from tests.routes import assert_optimal, every_route

MEETINGS = {f"miss {miss:g}": passing(miss) for miss in (0, 1e-6, 1e-4, 1e-2, 0.1, 0.5)} | {
    "three at one point": three_at_one_point(),
    "two on one path": two_on_one_path(),
}


@pytest.mark.parametrize("problem", MEETINGS.values(), ids=MEETINGS)
@every_route
def test_targets_that_meet_deceive_nobody(route, problem):
    assert_optimal(problem, route)


@pytest.mark.parametrize(
    "method, solver",
    [("micp", "clarabel"), ("micp", "scip"), ("baseline", "scip"), ("nonconvex", "scip"), ("micp", "highs")],
)
def test_where_targets_meet_cuts_are_made_and_counted(method, solver):
    assert solve(passing(0.0), method, solver=solver).subtour_cuts >= 1


def test_without_a_solver_the_fastest_open_one_is_taken():
    problem = generate(2, 20, seed=0)
    taken = {method: solve(problem, method) for method in ("micp", "baseline", "nonconvex")}
    assert taken["micp"].solver.startswith("clarabel") and taken["micp"].modeler == "cvxpy"
    assert taken["baseline"].solver.startswith("scip") and taken["nonconvex"].solver.startswith("scip")


@pytest.mark.parametrize("solver", ["scip", "highs"])
def test_a_time_limit_is_a_status_with_a_valid_bound(solver):
    problem = generate(10, 60, 1, seed=0)
    solution = solve(problem, "micp", "cvxpy", solver, time_limit=2.0)
    assert solution.status in ("feasible", "unknown")
    if solution.tours:
        assert solution.bound <= solution.objective == check(problem, solution.tours)


def test_a_gap_wide_enough_ends_the_solve_early():
    problem = generate(4, 40, 1, seed=2)
    solution = solve(problem, "micp", solver="scip", gap=0.5)
    assert solution.status == "optimal" and solution.bound <= optimum(problem) <= solution.objective * (1 + 1e-9)


def test_pruning_leaves_the_optimum():
    problem = generate(4, 40, 2, seed=1)
    assert solve(problem, "micp", solver="scip", prune=True).objective == pytest.approx(optimum(problem), rel=1e-4)


def test_a_target_at_the_depot_costs_nothing():
    solution = solve(instance(still(0, 0)), "micp", solver="scip")
    assert solution.status == "optimal" and solution.objective == 0.0 and solution.gap == 0.0


@pytest.mark.parametrize(
    "arguments, message",
    [
        ({"method": "magic"}, "method: expected one of exact, baseline, nonconvex, micp, found 'magic'"),
        ({"method": "micp", "solver": "magic"}, "solver: expected one of scip, clarabel"),
        ({"method": "micp", "modeler": "magic"}, "modeler: expected one of pyomo, cvxpy, found 'magic'"),
        ({"method": "nonconvex", "modeler": "cvxpy"}, "modeler: cvxpy cannot state method nonconvex"),
        (
            {"method": "baseline", "solver": "clarabel"},
            "solver: clarabel does not solve baseline; it solves: cvxpy micp",
        ),
        ({"solver": "scip"}, 'solver: method "exact" has none'),
        ({"modeler": "pyomo"}, 'modeler: method "exact" has none'),
        ({"subtour_cuts": False}, "subtour_cuts: False leaves out"),
        ({"method": "micp", "solver": "clarabel", "subtour_cuts": False}, "subtour_cuts: clarabel always cuts"),
        ({"time_limit": 0}, "time_limit: expected a number above 0, found 0"),
        ({"time_limit": float("nan")}, "time_limit"),
        ({"gap": -0.1}, "gap: expected a number of at least 0, found -0.1"),
        ({"threads": 0}, "threads: expected a whole number of at least 1, found 0"),
        ({"threads": 2}, 'threads: method "exact" runs on one core, found 2; leave it at 1'),
        ({"seed": -1}, "seed: expected a whole number of at least 0, found -1"),
    ],
)
def test_bad_arguments_are_input_errors_of_one_line(arguments, message):
    with pytest.raises(InputError) as caught:
        solve(generate(2, 20), **arguments)
    assert message in str(caught.value) and "\n" not in str(caught.value)
