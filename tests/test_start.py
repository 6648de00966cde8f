"""A solve begins from known tours: each solver takes them, and the answer is never longer."""

import dataclasses

import pytest

from mamttsp import FlowError, InputError, Solution, Tour, check, generate, solve
from mamttsp.backends import STARTS, Options, backend
from mamttsp.formulations import build_formulation
from mamttsp.formulations.points import begin_from, routes_of
from mamttsp.formulations.residuals import residuals
from mamttsp.graph import build_graph
from mamttsp.start import begin_with, no_longer
from mamttsp.timing import best_tours
from tests.examples import instance, still

ROUTES = [
    ("micp", "pyomo", "scip"), ("micp", "cvxpy", "scip"), ("baseline", "pyomo", "scip"), ("baseline", "cvxpy", "scip"),
    ("nonconvex", "pyomo", "scip"), ("micp", "cvxpy", "highs"), ("baseline", "cvxpy", "highs"),
    ("micp", "cvxpy", "clarabel"), ("micp", "pyomo", "clarabel"),
]  # fmt: skip


@pytest.fixture(scope="module")
def problem():
    """An instance that takes solvers longer than they get here, and tours of it that are not optimal."""
    made = generate(n_targets=10, total_window=40, n_agents=3, seed=7)
    return made, solve(made, method="micp", solver="clarabel", gap=0.2)


@pytest.mark.parametrize("method, modeler, solver", ROUTES)
def test_a_solver_begins_from_the_tours(method, modeler, solver, problem):
    """What the solver itself reports first is no longer than the tours: it has taken them."""
    made, start = problem
    seen = []

    def look(step):
        seen.append(step)
        raise KeyboardInterrupt  # the first look says it all

    limit = 4 if solver == "highs" else 60  # HiGHS is looked at between its solves only
    options = Options(time_limit=limit, progress=look, start=start.tours)
    formulation = build_formulation(method, modeler, build_graph(made, prune=True), made.n_agents)
    answer = backend(solver).solve(formulation, options)
    assert seen[0].objective is not None and seen[0].objective <= start.objective * (1 + 1e-6)
    assert answer.objective <= start.objective * (1 + 1e-6)


# as many targets as the licence allows that comes with the package
@pytest.mark.parametrize(
    "method, modeler, n_targets",
    [("micp", "pyomo", 2), ("micp", "cvxpy", 1), ("baseline", "cvxpy", 2), ("nonconvex", "pyomo", 2)],
)
def test_gurobi_begins_from_the_tours(method, modeler, n_targets, capfd):
    pytest.importorskip("gurobipy")
    small = generate(n_targets, total_window=20, seed=7)
    best = solve(small)
    solution = solve(small, method=method, modeler=modeler, solver="gurobi", start=best, verbose=True)
    assert solution.status == "optimal" and solution.objective == pytest.approx(best.objective, rel=2e-4)
    assert "Loaded user MIP start" in capfd.readouterr().out


@pytest.mark.parametrize("how", [{"method": "exact"}, {"method": "micp", "solver": "scip"}])
def test_the_answer_is_never_longer(how, problem):
    made, start = problem
    solution = solve(made, **how, time_limit=0.01, start=start)
    assert solution.objective == check(made, solution) <= start.objective * (1 + 1e-9)
    assert solution.status in ("feasible", "optimal")


def test_tours_do_as_well_as_a_solution(problem):
    made, start = problem
    assert begin_with(made, start) == begin_with(made, list(start.tours)) == tuple(start.tours)
    assert begin_with(made.with_agents(4), [*start.tours, Tour((), 0.0)]) == tuple(start.tours)
    assert begin_with(made, None) is None


@pytest.mark.parametrize(
    "start, message",
    [
        (3, "start: expected a Solution or a list of Tours, found 3"),
        ([3], "start[0]: expected a Tour"),
        ([], "start: no solution of this instance: target 0 is visited 0 times, not once, and 9 more"),
    ],
)
def test_what_is_no_solution_is_refused_in_one_line(start, message, problem):
    with pytest.raises(InputError) as caught:
        solve(problem[0], start=start)
    assert str(caught.value).startswith(message) and "\n" not in str(caught.value)


def test_the_solution_of_another_instance_is_refused(problem):
    with pytest.raises(InputError, match="start: no solution of this instance: "):
        solve(generate(10, 40, 3, seed=8), start=problem[1])


@pytest.mark.parametrize("solver", ["xpress", "copt", "mosek"])
def test_a_solver_that_takes_no_start_says_so(solver, problem):
    with pytest.raises(InputError, match=f"^start: {solver} begins from no tours here; {', '.join(STARTS)} do$"):
        solve(problem[0], method="micp", solver=solver, start=problem[1])


@pytest.mark.parametrize(
    "method, modeler", [("micp", "cvxpy"), ("baseline", "cvxpy"), ("micp", "pyomo"), ("baseline", "pyomo")]
)
def test_a_conic_program_reads_the_point_that_is_in_its_variables(method, modeler, problem):
    made, start = problem
    formulation = build_formulation(method, modeler, build_graph(made), made.n_agents)
    program = formulation.conic_program()
    begin_from(formulation, start.tours)
    x = program.read()
    slack = program.b - program.A @ x
    heads, *others = slack[program.n_linear :].reshape(-1, 3).T
    assert program.c @ x == pytest.approx(start.objective)
    assert abs(slack[: program.n_zero]).max() < 1e-9 and slack[program.n_zero : program.n_linear].min() > -1e-9
    assert (heads - (others[0] ** 2 + others[1] ** 2) ** 0.5).min() > -1e-9
    lifted, cones = program.lifted()
    point = lifted.read()
    assert (lifted.A @ point - lifted.b)[: lifted.n_zero] == pytest.approx(0.0, abs=1e-9)
    assert point[cones].ravel() == pytest.approx(slack[program.n_linear :])


def test_tours_at_leisure_are_begun_from_at_their_best_times():
    made = instance(still(10, 0), still(0, 10))
    late = [dataclasses.replace(tour, return_time=100.0) for tour in solve(made).tours]
    formulation = build_formulation("micp", "pyomo", build_graph(made), 1)
    begin_from(formulation, late)
    assert max(residuals(formulation.model).values()) < 1e-6
    graph = formulation.graph
    assert best_tours(graph, [list(route) for route in routes_of(graph, graph.counts, late)])[0] == pytest.approx(
        20 + 200**0.5
    )


def test_a_solver_that_contradicts_the_tours_is_found_out(problem):
    made, start = problem
    claim = Solution("infeasible", None, None, 1.0, (), "micp", "scip 10.0")
    with pytest.raises(FlowError, match="scip 10.0 calls infeasible what the tours"):
        no_longer(made, claim, start.tours, 1e-4)
    claim = Solution("unknown", None, 2 * start.objective, 1.0, (), "micp", "scip 10.0")
    with pytest.raises(FlowError, match="bound"):
        no_longer(made, claim, start.tours, 1e-4)


def test_tours_that_meet_the_bound_are_optimal(problem):
    made, start = problem
    claim = Solution("unknown", None, start.objective, 1.0, (), "micp", "scip 10.0")
    kept = no_longer(made, claim, start.tours, 1e-4)
    assert (kept.status, kept.objective, kept.tours) == ("optimal", pytest.approx(start.objective), start.tours)
    assert no_longer(made, dataclasses.replace(claim, bound=None), start.tours, 1e-4).status == "feasible"
