"""Solve a formulation, cut off the cycles that nobody flies, and solve again, until only tours are left."""

import dataclasses

from .backends.answer import answer_in_time
from .flow import FlowError, read_flow, shortest_unflyable, targets_of
from .solution import FEASIBLE, INFEASIBLE, OPTIMAL, UNKNOWN, Solution, relative_gap
from .timing import best_tours

#: how far a solver's bound may be off through its tolerances, relative to the objective and to the instance's size
BOUND_TOLERANCE = 1e-5


@dataclasses.dataclass
class _Record:
    """What the rounds so far have proved and done."""

    bound: float | None = None
    nodes: int | None = None
    cuts: int = 0
    runtime: float = 0.0
    solver: str = ""

    def add(self, answer):
        known = [bound for bound in (self.bound, answer.bound) if bound is not None]
        self.bound = max(known, default=None)
        self.nodes = answer.nodes if self.nodes is None else self.nodes + (answer.nodes or 0)
        self.cuts += answer.cuts
        self.runtime += answer.runtime
        self.solver = answer.solver or self.solver


def solve_without_cycles(formulation, run, options, clock):
    """Return the Solution of a formulation, its flow free of cycles that miss the depot.

    run: solve(formulation, options) of a back end; clock: the Clock that the building of the model and all rounds
    share. Each round's bound holds for all tours, so the greatest one stands. A round that a limit or Ctrl-C ends is
    the last; its incumbent counts if it is made of tours.
    """
    record = _Record()
    try:
        return _rounds(formulation, run, options, clock, record)
    except KeyboardInterrupt:  # between rounds, or in a back end that does not end with what stands
        return _solution(formulation, record, UNKNOWN)


def _rounds(formulation, run, options, clock, record):
    # What the solver's tolerance adds to the tours' real length must not open a gap that it has closed.
    strict = dataclasses.replace(options, gap=max(options.gap - BOUND_TOLERANCE, options.gap / 2))
    while True:
        answer = answer_in_time(run, formulation, strict, clock)
        record.add(answer)
        if answer.flow is None:
            return _solution(formulation, record, answer.status)
        paths, cycles = read_flow(formulation.graph, answer.flow)
        found = None if cycles else best_tours(formulation.graph, [list(path) for path in paths])
        if found is not None:
            return _solution(formulation, record, answer.status, found, options.gap)
        if answer.status != OPTIMAL:
            return _solution(formulation, record, UNKNOWN)
        record.cuts += _cut(formulation, paths, cycles)


def _cut(formulation, paths, cycles):
    """Cut off each cycle, or where there is none each path that only a tolerance lets through; return how many."""
    for targets in targets_of(formulation.graph, cycles):
        formulation.add_subtour_cut(targets)
    if cycles:
        return len(cycles)
    late = {part for path in paths if (part := shortest_unflyable(formulation.graph, path))}
    for part in late:
        formulation.add_path_cut(part)
    return len(late)


def _solution(formulation, record, status, found=None, gap=0.0):
    objective, tours, bound = None, (), record.bound
    if found is not None:
        objective, tours = found[0], tuple(found[1])
        bound = bound_below(objective, bound, formulation.graph.size)
        status = status_of(objective, bound, gap)
    return Solution(
        status=status,
        objective=objective,
        bound=None if status == INFEASIBLE else bound,
        runtime=record.runtime,
        tours=tours,
        method=formulation.method,
        solver=record.solver,
        modeler=formulation.modeler,
        build_time=formulation.build_time,
        nodes=record.nodes,
        subtour_cuts=record.cuts,
    )


def bound_below(objective, bound, size):
    """Return the bound, no greater than the objective; FlowError if it is greater by more than tolerances explain."""
    if bound is None or bound <= objective:
        return bound
    if bound > objective + BOUND_TOLERANCE * max(objective, size, 1.0):
        raise FlowError(f"the solver's bound {bound:.9g} is above the length {objective:.9g} of its own tours")
    return objective


def status_of(objective, bound, gap):
    """The solver's own objective may be short by its tolerance, so the gap is judged on the tours' real length."""
    proved = relative_gap(objective, bound)
    return OPTIMAL if proved is not None and proved <= gap else FEASIBLE
