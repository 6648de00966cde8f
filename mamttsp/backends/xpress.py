"""FICO Xpress, when installed: cvxpy formulations as a conic program, Pyomo ones through its plugin."""

import numpy as np
import xpress

from ..solution import FEASIBLE, INFEASIBLE, OPTIMAL, UNKNOWN
from .answer import licence_trouble
from .lifted import Found, report, solve_lifted

_VERSION = "xpress " + ".".join(xpress.__version__.split(".")[:2])
_SIZE_LIMIT = "too many rows and columns"
_ROW_TYPES = {"<": "L", "=": "E"}


def solve(formulation, options):
    """Solve a formulation of either modeler; SolverUnavailable without a licence that is large enough."""
    try:
        if formulation.modeler == "pyomo":
            from .pyomo_plugin import solve_with_plugin

            return solve_with_plugin(formulation, options, "xpress_direct", _controls, _VERSION)
        return solve_lifted(formulation, options, _run)
    except (xpress.SolverError, xpress.InterfaceError, RuntimeError) as error:
        if "licen" in str(error).lower() or _SIZE_LIMIT in str(error):
            raise licence_trouble("xpress", error) from error
        raise


def _controls(options, time_left):
    controls = {"miprelstop": options.gap, "threads": options.threads, "randomseed": options.seed % 2**31}
    return controls if time_left is None else controls | {"timelimit": time_left}


def _run(program, cones, options, clock):
    problem = xpress.problem()
    problem.setControl("outputlog", int(options.verbose))
    integers, columns = np.flatnonzero(program.integer), program.A.tocsc()
    problem.loadMIP(
        probname="mamttsp",
        rowtype=[_ROW_TYPES[sense] for sense in program.senses],
        rhs=program.b,
        objcoef=program.c,
        start=columns.indptr,
        rowind=columns.indices,
        rowcoef=columns.data,
        lb=np.maximum(program.lower, -xpress.infinity),
        ub=np.minimum(program.upper, xpress.infinity),
        coltype=["I"] * len(integers),
        entind=integers,
    )
    x = problem.getVariable()
    for head, *tail in cones:
        problem.addConstraint(xpress.Sum(x[k] ** 2 for k in tail) <= x[head] ** 2)
    for name, value in _controls(options, clock.left).items():
        problem.setControl(name, value)
    problem.addGapNotifyCallback(lambda *state: _watch(problem, options, clock), None, 0)
    problem.optimize()
    point = problem.getSolution() if _has_point(problem) else None
    return Found(_status(problem), point, problem.attributes.bestbound, problem.attributes.nodes, _VERSION)


def _watch(problem, options, clock):
    seen = problem.attributes
    report(options, clock, seen.mipobjval, seen.bestbound, seen.nodes, "xpress")


def _has_point(problem):
    return problem.attributes.solstatus in (xpress.SolStatus.OPTIMAL, xpress.SolStatus.FEASIBLE)


def _status(problem):
    status = problem.attributes.solstatus
    if status == xpress.SolStatus.OPTIMAL:
        return OPTIMAL
    if status == xpress.SolStatus.INFEASIBLE:
        return INFEASIBLE
    return FEASIBLE if _has_point(problem) else UNKNOWN
