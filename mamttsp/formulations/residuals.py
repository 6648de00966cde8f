"""How far the values of a model's variables are from satisfying it, one number for each family of constraints."""

import numpy as np
import pyomo.environ as pyo


def residuals(model):
    """Return {family: largest violation} of a Pyomo model or a cvxpy formulation whose variables have values.

    The families are those of `EQUATIONS`, and "subtour_cuts" if there are any, with the violation of each row as it is
    written: in units, s or flow, and in units squared for the cones of Pyomo. "bounds" and "integrality" are those of the
    variables. A value that is missing, or not a number, is an infinite violation.
    """
    return _cvxpy_residuals(model) if hasattr(model, "problem") else _pyomo_residuals(model)


def objective(model):
    """Return the value of the objective of a Pyomo model or a cvxpy formulation."""
    return float(model.problem.objective.value if hasattr(model, "problem") else pyo.value(model.length))


def _pyomo_residuals(model):
    families = model.component_objects(pyo.Constraint, active=True)
    found = {family.local_name: _worst(_row_violation(row) for row in family.values()) for family in families if family}
    variables = list(model.component_data_objects(pyo.Var))
    found["bounds"] = _worst(_outside(v.value, v.lb, v.ub) for v in variables)
    found["integrality"] = _worst(_off_integer(v.value) for v in variables if v.is_integer())
    return found


def _row_violation(row):
    return _outside(pyo.value(row.body, exception=False), row.lb, row.ub)


def _cvxpy_residuals(model):
    rows = model.constraints.items()
    found = {family: _worst(_cvxpy_violation(row) for row in constraints) for family, constraints in rows}
    variables = model.problem.variables()
    signed = [v for v in variables if v.is_nonneg()]
    whole = [v for v in variables if v.attributes["boolean"] or v.attributes["integer"]]
    found["bounds"] = _worst(_outside(x, 0.0, None) for v in signed for x in _entries(v))
    found["integrality"] = _worst(_off_integer(x) for v in whole for x in _entries(v))
    return found


def _cvxpy_violation(row):
    return np.max(row.violation(), initial=0.0)


def _entries(v):
    return [None] if v.value is None else np.ravel(v.value)


def _worst(violations):
    """Return the largest, infinity in place of NaN; 0 if there are none."""
    return float(np.max(np.nan_to_num(list(violations), nan=np.inf), initial=0.0))


def _outside(x, lower, upper):
    """Return by how much x is outside [lower, upper]; None is no bound."""
    if x is None:
        return np.inf
    return max(0.0, -np.inf if lower is None else lower - x, -np.inf if upper is None else x - upper)


def _off_integer(x):
    return np.inf if x is None else abs(x - round(x))
