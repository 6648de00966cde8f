"""The frame that commercial solvers' back ends share: their cones are of columns, as in a lifted conic program."""

from typing import NamedTuple

import numpy as np

from ..formulations.points import begin_from
from ..options import Clock, Progress
from ..solution import known_length, relative_gap
from .answer import Answer


class Found(NamedTuple):
    """What a solver says of a lifted program: status, its best point or None, bound, nodes, and its version."""

    status: str
    x: np.ndarray | None
    bound: float | None
    nodes: int | None
    solver: str


def solve_lifted(formulation, options, run):
    """Solve a cvxpy formulation with `run(program, cones, options, clock) -> Found` and return the Answer."""
    clock = Clock(options.time_limit)
    program, cones = formulation.conic_program().lifted()
    if options.start:
        begin_from(formulation, options.start)
    found = run(program, cones, options, clock)
    objective = flow = None
    if found.x is not None:
        x = np.asarray(found.x)
        program.load(x)
        objective, flow = known_length(program.c @ x), formulation.flow()
    return Answer(found.status, objective, known_length(found.bound), flow, found.nodes, clock.spent, found.solver)


def report(options, clock, objective, bound, nodes, phase):
    """Hand a running solve's numbers to `options.progress`, if there is one."""
    if options.progress:
        objective, bound = known_length(objective), known_length(bound)
        options.progress(Progress(clock.spent, objective, bound, relative_gap(objective, bound), nodes, phase))
