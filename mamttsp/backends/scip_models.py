"""From a Pyomo model or a cvxpy problem to a SCIP model, by public routes that leave SCIP in our hands.

Each converter returns (scip, load): the PySCIPOpt model, and a function that loads a solution of it into the
variables of the model it came from.
"""

import importlib.resources
import tempfile
from pathlib import Path

import numpy as np
import pyscipopt
from pyomo.repn.plugins.nl_writer import NLWriter

from ..formulations.conic_form import conic_data


def ipopt_options():
    """Return a context manager that gives the path of the option file for SCIP's Ipopt."""
    return importlib.resources.as_file(importlib.resources.files(__package__) / "mumps.opt")


def from_pyomo(model):
    """Hand over a Pyomo model (bilinear terms included) through an .nl file."""
    scip = pyscipopt.Model()
    scip.hideOutput()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "model.nl"
        with path.open("w") as stream:
            written = NLWriter().write(model, stream, linear_presolve=False)
        scip.readProblem(str(path))

    # SCIP names the columns of an .nl file x0, b1, i2, ...: a letter for the type, then the column's number.
    columns = {int(v.name[1:]): v for v in scip.getVars() if v.name[1:].isdigit()}

    def load(solution):
        for column, variable in enumerate(written.variables):
            variable.set_value(scip.getSolVal(solution, columns[column]), skip_validation=True)

    return scip, load


def from_cvxpy(model):
    """Hand over a cvxpy formulation as its conic data; each row of a cone becomes a variable of its own."""
    data = conic_data(model.problem)
    scip = pyscipopt.Model()
    scip.hideOutput()
    kinds = np.where(data.integer, "I", "C")
    x = [
        scip.addVar(obj=cost, vtype=kind, lb=_bound(lower), ub=_bound(upper))
        for cost, kind, lower, upper in zip(data.c, kinds, data.lower, data.upper)
    ]
    first_cone = data.n_equal + data.n_linear
    for row in range(first_cone):
        body = _row(data.A, row, x)
        scip.addCons(body == data.b[row] if row < data.n_equal else body <= data.b[row])
    for size in data.cones:
        _add_cone(scip, data, range(first_cone, first_cone + size), x)
        first_cone += size

    def load(solution):
        data.load([scip.getSolVal(solution, variable) for variable in x])

    return scip, load


def _add_cone(scip, data, rows, x):
    """Add ||w_1, w_2, ...|| <= w_0 for the slacks w = b - A x of these rows."""
    w = [scip.addVar(lb=None if k else 0.0) for k in range(len(rows))]
    for row, slack in zip(rows, w):
        scip.addCons(_row(data.A, row, x) + slack == data.b[row])
    scip.addCons(pyscipopt.quicksum(part * part for part in w[1:]) <= w[0] * w[0])


def _row(A, row, x):
    entries = slice(A.indptr[row], A.indptr[row + 1])
    return pyscipopt.quicksum(a * x[k] for a, k in zip(A.data[entries], A.indices[entries]))


def _bound(value):
    return float(value) if np.isfinite(value) else None
