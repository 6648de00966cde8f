"""The convex models as a `pyomo.kernel` block whose norm constraints are cones, for conic solvers (MOSEK, Gurobi)."""

import pyomo.environ as pyo
import pyomo.kernel as pmo
from pyomo.repn import generate_standard_repn

from ...validation import InputError


def to_kernel(model):
    """Return the model as a `pyomo.kernel` block: the same names and indices, cones as `pmo.conic.quadratic`.

    The baseline and the new MICP, cuts included. InputError: the nonconvex model, whose products are not conic.
    """
    block = pmo.block()
    twins = {}  # id of a Pyomo variable -> its kernel variable
    for family in model.component_objects(pyo.Var):
        copies = {index: _variable(v) for index, v in family.items()}
        twins.update((id(v), copies[index]) for index, v in family.items())
        setattr(block, family.local_name, _gather(family, copies, pmo.variable_dict))
    for family in model.component_objects(pyo.Constraint, active=True):
        copies = {index: _constraint(row, twins) for index, row in family.items()}
        setattr(block, family.local_name, _gather(family, copies, pmo.constraint_dict))
    (objective,) = model.component_objects(pyo.Objective, active=True)
    setattr(block, objective.local_name, pmo.objective(_linear(generate_standard_repn(objective), twins)))
    return block


def _gather(family, copies, container):
    return container(copies) if family.is_indexed() else copies[None]


def _variable(v):
    kind = pmo.IntegerSet if v.is_integer() else pmo.RealSet
    return pmo.variable(domain_type=kind, lb=v.lb, ub=v.ub, value=v.value)


def _constraint(row, twins):
    repn = generate_standard_repn(row.body)
    if repn.quadratic_vars:
        return _cone(repn, twins)
    lower, upper = (None if bound is None else bound - repn.constant for bound in (row.lb, row.ub))
    bounds = {"rhs": upper} if row.equality else {"lb": lower, "ub": upper}
    return pmo.linear_constraint([twins[id(v)] for v in repn.linear_vars], repn.linear_coefs, **bounds)


def _cone(repn, twins):
    """Return x^2 + y^2 - r^2 <= 0 with r >= 0 as a second-order cone."""
    squares = [
        (twins[id(a)], coefficient) for (a, b), coefficient in zip(repn.quadratic_vars, repn.quadratic_coefs) if a is b
    ]
    if len(squares) < len(repn.quadratic_vars):
        raise InputError("model: the nonconvex formulation has products of variables, which no cone can state")
    (r,) = [variable for variable, coefficient in squares if coefficient < 0]
    return pmo.conic.quadratic(r=r, x=[variable for variable, coefficient in squares if coefficient > 0])


def _linear(repn, twins):
    return sum(coefficient * twins[id(v)] for v, coefficient in zip(repn.linear_vars, repn.linear_coefs))
