"""COPT, when installed: cvxpy formulations as a conic program (Pyomo has no plugin for it)."""

import coptpy
import numpy as np
from coptpy import COPT

from ..solution import FEASIBLE, INFEASIBLE, OPTIMAL, UNKNOWN
from .answer import licence_trouble
from .lifted import Found, report, solve_lifted

_VERSION = f"copt {COPT.VERSION_MAJOR}.{COPT.VERSION_MINOR}"


def solve(formulation, options):
    """Solve a cvxpy formulation; SolverUnavailable without a licence that is large enough."""
    try:
        return solve_lifted(formulation, options, _run)
    except coptpy.CoptError as error:
        if "licen" in str(error).lower() or "limit" in str(error).lower():
            raise licence_trouble("copt", error) from error
        raise


def _run(program, cones, options, clock):
    config = coptpy.EnvrConfig()
    config.set("nobanner", "1")
    model = coptpy.Envr(config).createModel("mamttsp")
    model.setParam(COPT.Param.Logging, int(options.verbose))
    lower = np.where(program.senses == "=", program.b, -COPT.INFINITY)
    kinds = np.where(program.integer, COPT.INTEGER, COPT.CONTINUOUS)
    bounds = (np.clip(limit, -COPT.INFINITY, COPT.INFINITY) for limit in (program.lower, program.upper))
    model.loadMatrix(program.c, program.A.tocsc(), lower, program.b, *bounds, kinds)
    model.loadCone(len(cones), None, [3] * len(cones), cones.ravel().tolist())
    model.setParam(COPT.Param.RelGap, options.gap)
    model.setParam(COPT.Param.Threads, options.threads)
    if clock.left is not None:
        model.setParam(COPT.Param.TimeLimit, clock.left)
    if options.progress:
        watch = _Reporter(options, clock)
        model.setCallback(watch, COPT.CBCONTEXT_MIPRELAX | COPT.CBCONTEXT_MIPSOL)
    model.solve()
    point = np.array(model.getValues()) if model.hasmipsol else None
    return Found(_status(model), point, model.bestbnd, int(model.nodecnt), _VERSION)


class _Reporter(coptpy.CallbackBase):
    """Reports incumbent and bound at each node, and turns a KeyboardInterrupt into an orderly stop."""

    def __init__(self, options, clock):
        super().__init__()
        self.options, self.clock = options, clock

    def callback(self):
        best = self.getInfo(COPT.CBInfo.BestObj) if self.getInfo(COPT.CBInfo.HasIncumbent) else None
        try:
            report(self.options, self.clock, best, self.getInfo(COPT.CBInfo.BestBnd), None, "copt")
        except KeyboardInterrupt:
            self.interrupt()


def _status(model):
    if model.status == COPT.OPTIMAL:
        return OPTIMAL
    if model.status in (COPT.INFEASIBLE, COPT.INF_OR_UNB):  # lengths cannot be below zero: not unbounded
        return INFEASIBLE
    return FEASIBLE if model.hasmipsol else UNKNOWN
