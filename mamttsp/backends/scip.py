"""SCIP, for all three formulations: a Pyomo model goes over as an .nl file, a cvxpy problem as its conic program."""

import pyscipopt
from pyscipopt import SCIP_EVENTTYPE

from ..formulations.points import begin_from
from ..options import Clock, Progress
from ..solution import FEASIBLE, INFEASIBLE, OPTIMAL, UNKNOWN, known_length, relative_gap
from .answer import Answer
from .scip_models import from_conic, from_pyomo, ipopt_options

#: least time in s between two reports of progress
_REPORT_EVERY = 0.2
#: feasibility tolerance; SCIP's own 1e-6 acts on the squared cone and lets the big-M rows of the baseline leak
_FEASTOL = 1e-7


def solve(formulation, options):
    """Solve a formulation of either modeler; the point found is loaded into its model.

    `threads` reaches SCIP's LP solver only: SCIP's own search has one thread.
    """
    clock = Clock(options.time_limit)
    pyomo = formulation.modeler == "pyomo"
    scip, load, offer = from_pyomo(formulation.model) if pyomo else from_conic(formulation.conic_program())
    if options.start:
        begin_from(formulation, options.start)
        offer()
    with ipopt_options() as path:
        _set_parameters(scip, options, path, clock.left)
        watch = _Watch(options.progress, clock)
        scip.includeEventhdlr(watch, "watch", "reports incumbent and bound")
        scip.optimize()
    return _answer(scip, load, formulation, clock.spent)


def _set_parameters(scip, options, ipopt_file, time_limit):
    scip.hideOutput(not options.verbose)
    # The wheel's METIS aborts the whole process inside Ipopt's MUMPS unless another pivot order is chosen.
    scip.setParam("nlpi/ipopt/optfile", str(ipopt_file))
    scip.setParam("limits/gap", options.gap)
    scip.setParam("lp/threads", min(options.threads, 64))
    scip.setParam("randomization/randomseedshift", options.seed % 2**31)
    scip.setParam("numerics/feastol", _FEASTOL)
    if time_limit is not None:
        scip.setParam("limits/time", time_limit)


class _Watch(pyscipopt.Eventhdlr):
    """Reports incumbents and bounds while SCIP runs, and turns a KeyboardInterrupt into an orderly stop."""

    _EVENTS = (
        SCIP_EVENTTYPE.PRESOLVEROUND,
        SCIP_EVENTTYPE.LPSOLVED,
        SCIP_EVENTTYPE.NODESOLVED,
        SCIP_EVENTTYPE.BESTSOLFOUND,
    )

    def __init__(self, progress, clock):
        self.progress, self.clock, self.last = progress, clock, -_REPORT_EVERY

    def eventinit(self):
        for event in self._EVENTS:
            self.model.catchEvent(event, self)

    def eventexit(self):
        for event in self._EVENTS:
            self.model.dropEvent(event, self)

    def eventexec(self, event):
        now = self.clock.spent
        if self.progress is None or now < self.last + _REPORT_EVERY:
            return
        self.last = now
        objective, bound = (known_length(value()) for value in (self.model.getPrimalbound, self.model.getDualbound))
        nodes = self.model.getNTotalNodes()
        try:
            self.progress(Progress(now, objective, bound, relative_gap(objective, bound), nodes, "scip"))
        except KeyboardInterrupt:
            self.model.interruptSolve()


def _answer(scip, load, formulation, runtime):
    status, objective, flow = scip.getStatus(), None, None
    if scip.getNSols():
        load(scip.getBestSol())
        objective, flow = scip.getObjVal(), formulation.flow()
    bound = None if status == "infeasible" else known_length(scip.getDualbound())
    version = f"scip {scip.getMajorVersion()}.{scip.getMinorVersion()}"
    return Answer(_status(status, objective), objective, bound, flow, scip.getNTotalNodes(), runtime, version)


def _status(status, objective):
    if status in ("optimal", "gaplimit"):
        return OPTIMAL
    if status == "infeasible":
        return INFEASIBLE
    return UNKNOWN if objective is None else FEASIBLE
