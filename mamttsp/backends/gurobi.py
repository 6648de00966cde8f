"""Gurobi, when installed: cvxpy formulations as a conic program, Pyomo ones through its plugin."""

import gurobipy
import numpy as np
from gurobipy import GRB

from ..solution import FEASIBLE, INFEASIBLE, OPTIMAL, UNKNOWN
from .answer import licence_trouble
from .lifted import Found, report, solve_lifted

#: Gurobi's error codes for no licence, a model beyond a trial licence, and a licence of another kind
_LICENCE = (GRB.Error.NO_LICENSE, GRB.Error.SIZE_LIMIT_EXCEEDED, GRB.Error.CLOUD, GRB.Error.NETWORK)
_VERSION = "gurobi {}.{}".format(*gurobipy.gurobi.version())


def solve(formulation, options):
    """Solve a formulation of either modeler; SolverUnavailable without a licence that is large enough."""
    try:
        if formulation.modeler == "pyomo":
            from .pyomo_plugin import solve_with_plugin

            return solve_with_plugin(formulation, options, "gurobi_direct", _plugin_options, _VERSION)
        return solve_lifted(formulation, options, _run)
    except gurobipy.GurobiError as error:
        if error.errno in _LICENCE:
            raise licence_trouble("gurobi", error) from error
        raise


def _plugin_options(options, time_left):
    settings = {"MIPGap": options.gap, "Threads": options.threads, "Seed": options.seed % 2_000_000_000, "NonConvex": 2}
    return settings if time_left is None else settings | {"TimeLimit": time_left}


def _run(program, cones, options, clock):
    with gurobipy.Env(params={"OutputFlag": int(options.verbose)}) as env, gurobipy.Model(env=env) as model:
        kinds = np.where(program.integer, GRB.INTEGER, GRB.CONTINUOUS)
        x = model.addMVar(len(program.c), program.lower, program.upper, program.c, kinds)
        model.addMConstr(program.A, x, program.senses, program.b)
        if options.start:
            x.Start = program.read()
        for cone in cones:
            model.addConstr(x[cone[1:]] @ x[cone[1:]] <= x[cone[0]] * x[cone[0]])
        for name, value in _plugin_options(options, clock.left).items():
            model.setParam(name, value)
        model.optimize(lambda model, where: _watch(model, where, options, clock))
        point = x.X if model.SolCount else None
        return Found(_status(model), point, model.ObjBound, int(model.NodeCount), _VERSION)


def _watch(model, where, options, clock):
    if where == GRB.Callback.MIP:
        wanted = (GRB.Callback.MIP_OBJBST, GRB.Callback.MIP_OBJBND, GRB.Callback.MIP_NODCNT)
        best, bound, nodes = map(model.cbGet, wanted)
        report(options, clock, best, bound, int(nodes), "gurobi")


def _status(model):
    if model.Status == GRB.OPTIMAL:
        return OPTIMAL
    if model.Status in (GRB.INFEASIBLE, GRB.INF_OR_UNBD):  # lengths cannot be below zero: not unbounded
        return INFEASIBLE
    return FEASIBLE if model.SolCount else UNKNOWN
