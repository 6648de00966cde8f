"""How far the values of a model's variables are from satisfying it, one number for each family of constraints."""

import numpy as np
import pyomo.environ as pyo

from .pyomo.cones import cone_violation


def residuals(model):
    """Return {family: largest violation} of a Pyomo model or a cvxpy formulation whose variables have values.

    The families are those of `EQUATIONS`, and "subtour_cuts" if there are any; "bounds" and "integrality" are those of
    the variables. A violation is in the units of its row (units, s, flow); that of a cone is by how much the
    displacement exceeds the length. A value that is missing is an infinite violation.
    """
    return _cvxpy_residuals(model) if hasattr(model, "problem") else _pyomo_residuals(model)


def objective(model):
    """Return the value of the objective of a Pyomo model or a cvxpy formulation."""
    return float(model.problem.objective.value if hasattr(model, "problem") else pyo.value(model.length))


def _pyomo_residuals(model):
    families = model.component_objects(pyo.Constraint, active=True)
    found = {family.local_name: _pyomo_violation(family) for family in families if len(family)}
    variables = list(model.component_data_objects(pyo.Var))
    whole = [v.value for v in variables if v.is_integer()]
    return found | {"bounds": _outside_bounds(variables, [v.value for v in variables]), "integrality": _fraction(whole)}


def _pyomo_violation(family):
    rows = list(family.values())
    if family.local_name == "norm":
        return _worst(cone_violation(row) for row in rows)
    return _outside_bounds(rows, [pyo.value(row.body, exception=False) for row in rows])


def _outside_bounds(items, values):
    """Return how far the worst value is outside [lb, ub] of its variable or row."""
    x = np.array(values, dtype=float)
    lower = [-np.inf if item.lb is None else item.lb for item in items]
    upper = [np.inf if item.ub is None else item.ub for item in items]
    return _worst(np.maximum(lower - x, x - upper))


def _cvxpy_residuals(model):
    found = {
        family: _worst(np.concatenate([_cvxpy_violation(row) for row in rows]))
        for family, rows in model.constraints.items()
    }
    variables = model.problem.variables()
    below = [-x for v in variables if v.is_nonneg() for x in _entries(v)]
    whole = [x for v in variables if v.attributes["boolean"] or v.attributes["integer"] for x in _entries(v)]
    return found | {"bounds": _worst([*below, *(_entries(model.y) - 1.0)]), "integrality": _fraction(whole)}


def _cvxpy_violation(row):
    """Return the violations of the rows of a cvxpy constraint, flat."""
    if hasattr(row, "cone_sizes"):  # cp.SOC
        lengths, displacements = row.args
        if lengths.value is None or displacements.value is None:
            return np.array([np.nan])
        return np.linalg.norm(displacements.value, axis=row.axis) - lengths.value
    return np.ravel(np.array(row.residual, dtype=float))


def _entries(variable):
    return np.ravel(np.array(variable.value, dtype=float))


def _fraction(values):
    """Return how far the worst value is from a whole number."""
    x = np.array(values, dtype=float)
    return _worst(np.abs(x - np.round(x)))


def _worst(violations):
    """Return the largest violation, 0 if there is none, infinity if one is not a number."""
    found = np.array(list(violations), dtype=float)
    return float(np.max(np.where(np.isnan(found), np.inf, found), initial=0.0))
