"""From a Pyomo model or a conic program to a SCIP model, by public routes that leave SCIP in our hands.

Each converter returns (scip, load, offer): the PySCIPOpt model; a function that loads a solution of it into the
variables of the model it came from; and one that offers SCIP the values that these variables have, to begin from.
"""

import importlib.resources
import tempfile
from pathlib import Path

import numpy as np
import pyscipopt


def ipopt_options():
    """Return a context manager that gives the path of the option file for SCIP's Ipopt."""
    return importlib.resources.as_file(importlib.resources.files(__package__) / "mumps.opt")


def from_pyomo(model):
    """Hand over a Pyomo model (bilinear terms included) through an .nl file."""
    from pyomo.repn.plugins.nl_writer import NLWriter

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

    def offer():
        _offer(scip, ((columns[column], variable.value) for column, variable in enumerate(written.variables)))

    return scip, load, offer


def from_conic(program):
    """Hand over a ConicProgram; each row of a cone becomes a variable of its own."""
    scip = pyscipopt.Model()
    scip.hideOutput()
    kinds = np.where(program.integer, "I", "C")
    x = [
        scip.addVar(obj=cost, vtype=kind, lb=_bound(lower), ub=_bound(upper))
        for cost, kind, lower, upper in zip(program.c, kinds, program.lower, program.upper)
    ]
    for row in range(program.n_linear):
        body = _row(program.A, row, x)
        scip.addCons(body == program.b[row] if row < program.n_zero else body <= program.b[row])
    slacks = [_add_cone(scip, program, range(row, row + 3), x) for row in range(program.n_linear, len(program.b), 3)]

    def load(solution):
        program.load([scip.getSolVal(solution, variable) for variable in x])

    def offer():
        point = program.read()
        cones = (program.b - program.A @ point)[program.n_linear :]
        _offer(scip, zip([*x, *(slack for cone in slacks for slack in cone)], np.concatenate([point, cones])))

    return scip, load, offer


def _offer(scip, values):
    """Let SCIP begin from a point, given as (variable, value) pairs; SCIP itself looks whether it is feasible."""
    solution = scip.createSol()
    for variable, value in values:
        scip.setSolVal(solution, variable, value)
    scip.addSol(solution)


def _add_cone(scip, program, rows, x):
    """Add ||w_1, w_2, ...|| <= w_0 for the slacks w = b - A x of these rows, and return these variables."""
    w = [scip.addVar(lb=None if k else 0.0) for k in range(len(rows))]
    for row, slack in zip(rows, w):
        scip.addCons(_row(program.A, row, x) + slack == program.b[row])
    scip.addCons(pyscipopt.quicksum(part * part for part in w[1:]) <= w[0] * w[0])
    return w


def _row(A, row, x):
    entries = slice(A.indptr[row], A.indptr[row + 1])
    return pyscipopt.quicksum(a * x[k] for a, k in zip(A.data[entries], A.indices[entries]))


def _bound(value):
    return float(value) if np.isfinite(value) else None
