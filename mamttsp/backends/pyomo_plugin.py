"""A commercial solver through Pyomo's own plugin for it."""

import pyomo.environ as pyo
from pyomo.opt import TerminationCondition

from ..formulations.points import begin_from
from ..options import Clock
from ..solution import FEASIBLE, INFEASIBLE, OPTIMAL, UNKNOWN, known_length
from .answer import Answer, SolverUnavailable

_INFEASIBLE = (TerminationCondition.infeasible, TerminationCondition.infeasibleOrUnbounded)


def solve_with_plugin(formulation, options, plugin, settings, solver):
    """Solve a Pyomo formulation with the plugin of that name and return the Answer.

    settings: function (options, seconds left) -> the solver's own options; solver: its name and version. There is no
    progress on this route.
    """
    clock = Clock(options.time_limit)
    factory = pyo.SolverFactory(plugin)
    if not factory.available(exception_flag=False):
        raise SolverUnavailable(f"solver: {plugin} is not available: the package or its licence is missing")
    factory.options.update(settings(options, clock.left))
    begin = {}
    if options.start:
        begin_from(formulation, options.start)
        begin["warmstart"] = True
    results = factory.solve(formulation.model, tee=options.verbose, load_solutions=False, **begin)
    objective = flow = None
    if len(results.solution) and results.solution(0).variable:
        formulation.model.solutions.load_from(results)
        objective, flow = known_length(pyo.value(_objective(formulation.model))), formulation.flow()
    ended = results.solver.termination_condition
    bound = None if ended in _INFEASIBLE else known_length(results.problem.lower_bound)
    return Answer(_status(ended, objective), objective, bound, flow, None, clock.spent, solver)


def _objective(model):
    return next(model.component_data_objects(pyo.Objective, active=True))


def _status(ended, objective):
    if ended == TerminationCondition.optimal:
        return OPTIMAL
    if ended in _INFEASIBLE:
        return INFEASIBLE
    return UNKNOWN if objective is None else FEASIBLE
