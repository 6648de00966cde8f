"""The routes through open solvers from an instance to its optimum, and what each must deliver."""

import pytest

from mamttsp import check, solve
from tests.oracle import optimum

#: (method, modeler, solver)
ROUTES = [
    ("exact", None, None),
    ("micp", "cvxpy", "clarabel"),
    ("micp", "pyomo", "clarabel"),
    ("micp", "cvxpy", "scip"),
    ("micp", "pyomo", "scip"),
    ("micp", "cvxpy", "highs"),
    ("baseline", "cvxpy", "scip"),
    ("baseline", "pyomo", "scip"),
    ("baseline", "cvxpy", "highs"),
    ("nonconvex", "pyomo", "scip"),
]
every_route = pytest.mark.parametrize("route", ROUTES, ids=lambda route: "-".join(filter(None, route)))


def assert_optimal(problem, route):
    """Solve by the route; tours, length and bound must agree with enumeration, at 1e-4 relative."""
    method, modeler, solver = route
    expected = optimum(problem)
    solution = solve(problem, method=method, modeler=modeler, solver=solver)
    assert solution.status == "optimal"
    assert solution.objective == pytest.approx(expected, rel=1e-4)
    assert solution.bound <= expected * (1 + 1e-6)
    assert check(problem, solution.tours) == pytest.approx(solution.objective, rel=1e-9)
