"""The one front door: an instance and a method in, a checked Solution out."""

import dataclasses
from collections.abc import Callable, Iterable

from .backends import METHODS, Options, backend, choose
from .instance import Instance
from .options import Clock, Progress
from .solution import INFEASIBLE, UNKNOWN, Solution
from .start import begin_with, no_longer
from .tours import HasTours, Tour, check
from .validation import InputError, brief, of_type
from .warm_up import PARTS, ensure_compiled

#: our own solver, and the paper's formulations
ALL_METHODS = ("exact", *METHODS)


def solve(
    instance: Instance,
    method: str = "exact",
    modeler: str | None = None,
    solver: str | None = None,
    time_limit: float | None = None,
    gap: float = 1e-4,
    threads: int = 1,
    seed: int = 0,
    verbose: bool = False,
    progress: Callable[[Progress], None] | None = None,
    prune: bool = False,
    subtour_cuts: bool = True,
    start: Iterable[Tour] | HasTours | None = None,
) -> Solution:
    """Return a Solution of the instance, its tours checked.

    method: "exact" (our own solver), "micp", "baseline" or "nonconvex" (the paper's formulations).
    modeler: "pyomo" or "cvxpy", for a formulation; solver: one of backends.SOLVERS, for a formulation; None takes the
    fastest open one. time_limit: s of wall time, None for none. Building the model counts; compiling what a method
    needs, once on a machine, does not. gap: relative gap, as a fraction, that counts as optimal: what a solver has
    searched to the end may still be "feasible" if its accuracy (about 1e-5) does not prove a smaller one. threads,
    seed, verbose: handed to the solver; progress: called with an options.Progress now and then (options.Options says
    which solvers do without). prune: leave out the edges that no agent can fly in time (the exact method always does).

    subtour_cuts: cut off the cycles that a formulation accepts and nobody flies, and solve again until none is left.
    With False the paper's model is solved once as it stands, and the answer is a PaperSolution.

    start: a Solution of this instance, or its tours, to begin from, for "exact" and the solvers in backends.STARTS. The
    answer is never longer than they are.

    A limit, or Ctrl-C, is a status and never an exception. InputError: a bad argument, or a solver that cannot be used
    here; FlowError: the solver's answer contradicts itself.

    >>> from mamttsp import Instance, Target, solve
    >>> target = Target(times=[0, 10], points=[[3, 4], [3, 4]], windows=[[2, 8]])
    >>> instance = Instance([target], n_agents=1, depot=(0, 0), max_speed=4, horizon=10)
    >>> solution = solve(instance)
    >>> solution.status, round(solution.objective, 3)
    ('optimal', 10.0)
    >>> solve(instance, method="micp", solver="scip").status
    'optimal'
    """
    of_type("instance", instance, Instance)
    options = Options(time_limit, gap, threads, seed, verbose, progress, begin_with(instance, start))
    if method == "exact":
        return _solve_exact(instance, options, modeler, solver, subtour_cuts)
    if method not in METHODS:
        raise InputError(f"method: expected one of {', '.join(ALL_METHODS)}, found {brief(method)}")
    modeler, solver = choose(method, modeler, solver, plain=not subtour_cuts, start=start is not None)
    found = _solve_formulation(instance, method, modeler, solver, prune, subtour_cuts, options)
    return _finished(instance, found, options) if subtour_cuts else _explained(instance, found)


def _solve_formulation(instance, method, modeler, solver, prune, subtour_cuts, options):
    # Here, because the exact method does without them.
    from .cut_loop import solve_without_cycles
    from .formulations import build_formulation, graph_for
    from .plain_model import PaperSolution, paper_solution

    clock = Clock(options.time_limit)
    kind, solve_with = (Solution, solve_without_cycles) if subtour_cuts else (PaperSolution, paper_solution)
    try:
        if solver in PARTS:
            ensure_compiled(solver)
            clock = Clock(options.time_limit)
        run = backend(solver).solve
        formulation = build_formulation(method, modeler, graph_for(method, instance, prune))
        found = solve_with(formulation, run, options, clock)
    except KeyboardInterrupt:  # before the solver has the model: then nothing is known
        return kind(UNKNOWN, None, None, 0.0, (), method, solver, modeler, build_time=clock.spent)
    return dataclasses.replace(found, solver=found.solver or solver)  # it may not have had its turn


def _solve_exact(instance, options, modeler, solver, subtour_cuts):
    for name, value in (("modeler", modeler), ("solver", solver)):
        if value is not None:
            raise InputError(f'{name}: method "exact" has none, found {brief(value)}; {", ".join(METHODS)} have')
    if not subtour_cuts:
        raise InputError('subtour_cuts: False leaves out the cuts of a formulation, and method "exact" has none')
    if options.threads > 1:
        raise InputError(f'threads: method "exact" runs on one core, found {options.threads}; leave it at 1')
    from .exact import solve_exact

    try:
        ensure_compiled()
        found = solve_exact(instance, options)
    except KeyboardInterrupt:  # before the search: then nothing is known
        found = Solution(UNKNOWN, None, None, 0.0, (), "exact", "mamttsp exact")
    return _finished(instance, found, options)


def _finished(instance, solution, options):
    """Return the solution once `check` agrees with its tours, no longer than those it began from; TourError with the
    reason if `check` does not agree."""
    if solution.tours:
        solution = dataclasses.replace(solution, objective=check(instance, solution.tours))
    if options.start is not None:
        solution = no_longer(instance, solution, options.start, options.gap)
    return _explained(instance, solution)


def _explained(instance, solution):
    """Return the solution, with the reason why there are no tours if that is proved."""
    if solution.status != INFEASIBLE:
        return solution
    from .infeasibility import NO_SHORT_REASON, why_infeasible  # here: few instances need it

    return dataclasses.replace(solution, reason=why_infeasible(instance) or NO_SHORT_REASON)
