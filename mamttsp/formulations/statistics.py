"""How large a model is: counted on the model, and in closed form from (n, m, |V|, |E|)."""

from typing import NamedTuple

import pyomo.environ as pyo
from pyomo.repn import generate_standard_repn


class Statistics(NamedTuple):
    """Sizes of a model.

    variables: all scalar variables, with `binaries` and `integers` among them; linear_rows: scalar linear equations and
    inequalities (lower <= f <= upper is two; bounds and integrality of a variable are none); cones: second-order
    cones; bilinear_rows: scalar equations with a product of two variables.
    """

    variables: int
    binaries: int
    integers: int
    linear_rows: int
    cones: int
    bilinear_rows: int


def closed_form(method, n, m, V, E):
    """Return the Statistics of a formulation in Pyomo for n targets, m agents, |V| = V nodes and |E| = E edges."""
    V_seg = V - 2
    flow_rows = 2 * m + n + V_seg * m  # (2)-(5)
    if method == "baseline":
        # t; y, l, l_bar, l_xy.  Rows: (6), (7)-(9).
        return Statistics(m * (V + 5 * E), m * E, 0, flow_rows + m * (2 * V + 4 * E), m * E, 0)
    if method == "nonconvex":
        # t, p; y, l, l_xy, z_p, z_t, z'_p, z'_t.  Rows: (6), (12)-(14).
        return Statistics(m * (3 * V + 10 * E), m * E, 0, flow_rows + m * (4 * V + 3 * E), m * E, 6 * m * E)
    # alpha; y, l, l_xy, z_p, z_t, z'_p, z'_t.  Rows: (18)-(20), (21), (22), (23)-(28).
    return Statistics(1 + 10 * E, E, 1, 4 + n + 2 * V_seg + 11 * E, E, 0)


def statistics(model):
    """Return the Statistics of a Pyomo model or of a cvxpy formulation."""
    return _count_cvxpy(model.problem) if hasattr(model, "problem") else _count_pyomo(model)


def _count_pyomo(model):
    variables = list(model.component_data_objects(pyo.Var))
    rows = {"linear": 0, "cone": 0, "bilinear": 0}
    for row in model.component_data_objects(pyo.Constraint, active=True):
        rows[_kind(row.body)] += row.expr.nargs() - 1  # lower <= body <= upper has three parts, all others two
    binaries = sum(v.is_binary() for v in variables)
    integers = sum(v.is_integer() for v in variables) - binaries
    return Statistics(len(variables), binaries, integers, *rows.values())


def _kind(body):
    """Tell a linear body, a cone (a quadratic in squares only) and a bilinear body apart."""
    if body.polynomial_degree() <= 1:
        return "linear"
    squares = all(a is b for a, b in generate_standard_repn(body).quadratic_vars)
    return "cone" if squares else "bilinear"


def _count_cvxpy(problem):
    import cvxpy as cp  # here, so that Pyomo models do without cvxpy's slow import

    variables = problem.variables()
    binaries = sum(v.size for v in variables if v.attributes["boolean"])
    integers = sum(v.size for v in variables if v.attributes["integer"])
    cones = sum(c.num_cones() for c in problem.constraints if isinstance(c, cp.SOC))
    linear_rows = sum(c.size for c in problem.constraints if not isinstance(c, cp.SOC))
    return Statistics(sum(v.size for v in variables), binaries, integers, linear_rows, cones, 0)
