"""A Pyomo model as a ConicProgram."""

import numpy as np
from pyomo.environ import Var
from pyomo.opt import WriterFactory
from pyomo.repn import generate_standard_repn
from scipy import sparse

from ..conic_form import ConicProgram


def standard_form(model):
    """Return the ConicProgram of a model (baseline or MICP), with the cuts that it has by now.

    The norm constraints are compiled apart: Pyomo's own standard form is for linear rows.
    """
    model.norm.deactivate()
    try:
        form = WriterFactory("compile_standard_form").write(model, mixed_form=True)
    finally:
        model.norm.activate()
    number = {id(variable): k for k, variable in enumerate(form.columns)}
    columns = {
        component.local_name: np.array([number[id(variable)] for variable in component.values()])
        for component in model.component_objects(Var)
    }
    kind = np.array([row.bound_type for row in form.rows])
    sign = np.where(kind == -1, -1.0, 1.0)  # a row of kind -1 is A x >= rhs
    A, rhs = sparse.csr_array(sparse.diags_array(sign) @ form.A), sign * np.asarray(form.rhs, dtype=float)
    cones = _cone_rows(model.norm, number, A.shape[1])
    lower, upper = np.array([(x.lb, x.ub) for x in form.columns], dtype=float).T  # None becomes NaN

    def load(x):
        for variable, value in zip(form.columns, np.asarray(x).tolist(), strict=True):
            variable.set_value(value, skip_validation=True)

    return ConicProgram(
        c=np.asarray(form.c.todense(), dtype=float).ravel(),
        A=sparse.csr_array(sparse.vstack([A[kind == 0], A[kind != 0], cones])),
        b=np.concatenate([rhs[kind == 0], rhs[kind != 0], np.zeros(cones.shape[0])]),
        n_zero=int((kind == 0).sum()),
        n_nonneg=int((kind != 0).sum()),
        lower=np.where(np.isnan(lower), -np.inf, lower),
        upper=np.where(np.isnan(upper), np.inf, upper),
        integer=np.array([x.is_integer() for x in form.columns]),
        columns=columns,
        load=load,
        read=lambda: np.array([variable.value for variable in form.columns], dtype=float),
    )


def _cone_rows(norm, number, width):
    """Return the rows of x^2 + y^2 - head^2 <= 0, three for each constraint: head, x, y, each times -1."""
    picked = []
    for row in norm.values():
        form = generate_standard_repn(row.body)
        order = np.argsort(form.quadratic_coefs, kind="stable")  # the head has the negative coefficient
        picked += [number[id(form.quadratic_vars[k][0])] for k in order]
    size = len(picked)
    return sparse.csr_array((-np.ones(size), (np.arange(size), picked)), shape=(size, width))
