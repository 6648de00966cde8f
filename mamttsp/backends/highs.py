"""HiGHS, which has no cones, through an outer approximation of a cvxpy formulation.

The master has the linear rows and tangents of the cones, so its dual bound is a bound on the formulation. Its integers,
held fixed, give an incumbent once enough tangents have been added for the cones to hold.
"""

import highspy

from ..formulations.points import begin_from
from ..options import Clock, Progress
from ..solution import FEASIBLE, INFEASIBLE, OPTIMAL, UNKNOWN, known_length, relative_gap
from .answer import Answer
from .cone_cuts import ConeCuts
from .highs_master import Master

#: tangents at fixed integers are added at most so often in a row
_FIXED_ROUNDS = 50


def solve(formulation, options):
    """Solve a cvxpy formulation by outer approximation; the point found is loaded into its problem."""
    clock = Clock(options.time_limit)
    search = _Search(formulation.conic_program(), options, clock)
    try:
        if options.start:
            begin_from(formulation, options.start)
            search.take(search.program.read())
        status = search.run()
    except KeyboardInterrupt:  # between its solves, or from the progress callback; in a solve it is the master's
        status = search.standing
    flow = None
    if search.best is not None:
        search.program.load(search.best)
        flow = formulation.flow()
    version = ".".join(search.master.highs.version().split(".")[:2])
    return Answer(status, search.objective, search.bound, flow, search.nodes, clock.spent, f"highs {version}")


class _Search:
    """One outer approximation: program, master, and what is known so far."""

    def __init__(self, program, options, clock):
        self.program, self.options, self.clock = program, options, clock
        self.cones, self.master = ConeCuts(program), Master(program, options)
        self.best, self.objective, self.bound, self.nodes = None, None, None, 0

    def run(self):
        """Alternate between the master and the tangents it lacks, until the gap is closed or a limit comes."""
        self.master.add(*self.cones.first())
        while not self.clock.over and not self.master.stopped:
            status, x, bound = self.master.solve(self.clock, self.best)
            self.nodes += max(self.master.highs.getInfo().mip_node_count, 0)
            if status == highspy.HighsModelStatus.kInfeasible:
                return INFEASIBLE
            self._raise_bound(bound)
            if x is not None:
                self._improve(x)
            self._report()
            if self._closed():
                return OPTIMAL
            if status != highspy.HighsModelStatus.kOptimal:
                break
        return self.standing

    @property
    def standing(self):
        """The status of a search that has not come to its end."""
        return UNKNOWN if self.best is None else FEASIBLE

    def _improve(self, x):
        """Add the tangents that x violates, and go on with its integers fixed until the cones hold."""
        for _ in range(_FIXED_ROUNDS):
            R, upper = self.cones.violated(x)
            if not len(upper):
                return self.take(x)
            self.master.add(R, upper)
            x = self.master.solve_fixed(x, self.clock)
            if x is None:
                return None

    def take(self, x):
        """Keep a point of the cones and all rows if it is better than the best so far."""
        objective = known_length(self.program.c @ x)
        if self.objective is None or objective < self.objective:
            self.best, self.objective = x, objective

    def _raise_bound(self, bound):
        bound = known_length(bound)
        if bound is not None:
            self.bound = bound if self.bound is None else max(self.bound, bound)

    def _closed(self):
        gap = relative_gap(self.objective, self.bound)
        return gap is not None and gap <= self.options.gap

    def _report(self):
        if self.options.progress:
            gap = relative_gap(self.objective, self.bound)
            self.options.progress(Progress(self.clock.spent, self.objective, self.bound, gap, self.nodes, "highs"))
