"""HiGHS with the linear rows of a conic program, and tangents of its cones as they come."""

import threading

import highspy
import numpy as np

from ..silent_highs import SilentHighs

#: feasibility tolerances, the second one to confirm what the first calls infeasible: HiGHS says so of feasible programs
#: where targets miss each other by about its tolerance
_TOLERANCES = (1e-9, 1e-6)
_SOLVED = (highspy.HighsModelStatus.kOptimal, highspy.HighsModelStatus.kTimeLimit, highspy.HighsModelStatus.kInterrupt)


class Master:
    """A mixed-integer linear program in HiGHS whose optimum bounds the conic program's from below."""

    def __init__(self, program, options):
        self.program, self.highs = program, SilentHighs()
        self.highs.setOptionValue("output_flag", options.verbose)
        self.highs.setOptionValue("threads", options.threads)
        self.highs.setOptionValue("random_seed", options.seed % 2**31)
        self.highs.setOptionValue("mip_rel_gap", options.gap / 2)
        # At its tolerance the presolve of HiGHS 1.15 loses optima, with room to spare, and calls the rest optimal.
        self.highs.setOptionValue("presolve", "off")
        self.highs.HandleUserInterrupt = True
        self.stopped = False  # by Ctrl-C
        self.highs.passModel(_linear_part(program))
        self.integers = np.flatnonzero(program.integer).astype(np.int32)

    def add(self, R, upper):
        """Add rows R x <= upper."""
        if len(upper):
            lower = np.full(len(upper), -highspy.kHighsInf)
            self.highs.addRows(len(upper), lower, upper, R.nnz, R.indptr[:-1], R.indices, R.data)

    def solve(self, clock, start=None):
        """Solve as it stands, from a point if there is one; return (status, x or None, lower bound)."""
        for tolerance in _TOLERANCES:
            self.highs.setOptionValue("mip_feasibility_tolerance", tolerance)
            if start is not None:
                solution = highspy.HighsSolution()
                solution.col_value = start
                self.highs.setSolution(solution)
            x = self._run(clock, relaxed=False)
            if self.highs.getModelStatus() != highspy.HighsModelStatus.kInfeasible:
                break
        return self.highs.getModelStatus(), x, self.highs.getInfo().mip_dual_bound

    def solve_fixed(self, x, clock):
        """Solve with the integers fixed at their values in x; return the new point, None if there is none."""
        at = np.round(x[self.integers])
        self.highs.changeColsBounds(len(at), self.integers, at, at)
        point = self._run(clock, relaxed=True)
        lower, upper = self.program.lower[self.integers], self.program.upper[self.integers]
        self.highs.changeColsBounds(len(at), self.integers, lower, upper)
        return point

    def _run(self, clock, relaxed):
        self.highs.setOptionValue("solve_relaxation", relaxed)
        if clock.left is not None:
            self.highs.setOptionValue("time_limit", self.highs.getRunTime() + clock.left)
        self._solve()
        found = self.highs.getInfo().primal_solution_status == highspy.SolutionStatus.kSolutionStatusFeasible
        usable = found and self.highs.getModelStatus() in _SOLVED
        return np.array(self.highs.getSolution().col_value) if usable else None

    def _solve(self):
        """Let HiGHS run in a thread of its own, so that Ctrl-C reaches this one and ends the run with what stands."""
        thread = threading.Thread(target=self.highs.run, daemon=True)
        try:
            thread.start()
            _wait(thread)
        except KeyboardInterrupt:
            self.stopped = True
            self.highs.cancelSolve()
            _wait(thread)


def _wait(thread):
    """Wait for a thread in steps: on Windows nothing else lets Ctrl-C through."""
    while thread.is_alive():
        thread.join(0.1)


def _linear_part(program):
    rows = program.n_linear
    A, b = program.A[:rows], program.b[:rows]
    lp = highspy.HighsLp()
    lp.num_col_, lp.num_row_ = len(program.c), rows
    lp.col_cost_, lp.col_lower_, lp.col_upper_ = program.c, program.lower, program.upper
    lp.row_lower_ = np.where(np.arange(rows) < program.n_zero, b, -highspy.kHighsInf)
    lp.row_upper_ = b
    lp.a_matrix_.format_ = highspy.MatrixFormat.kRowwise
    lp.a_matrix_.start_, lp.a_matrix_.index_, lp.a_matrix_.value_ = A.indptr, A.indices, A.data
    kinds = (highspy.HighsVarType.kContinuous, highspy.HighsVarType.kInteger)
    lp.integrality_ = [kinds[whole] for whole in program.integer.astype(int)]
    return lp
