"""Clarabel on one conic program, and what its dual point proves, whatever its status.

Clarabel writes min c x subject to A x + s = b, s in K. For any z in the dual cone K* and any x that is feasible,
c x = r x - b z + z s >= r x - b z with the residual r = c + A' z. So -b z is a bound only up to r x; with a bound on
each |x_j| that is a number, and the sum of both is a proved bound (up to rounding of these few operations), even if the
solver stopped early. The same inequality with c = 0 proves that nothing is feasible, if -b z + r x > 0 for all x.
"""

import clarabel
import numpy as np
from scipy import sparse


def minimise(c, A, b, n_zero, n_nonneg, threads=1, time_limit=None, refined=True):
    """Return Clarabel's solution of min c x over b - A x in {0}^n_zero x R_+^n_nonneg x second-order cones of 3.

    refined: its linear systems are solved to the last digit; without that it takes two thirds of the time, and its dual
    point, which proves what it proves, is hardly worse.
    """
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.max_threads = threads
    settings.iterative_refinement_enable = refined
    settings.presolve_enable = False  # it looks for infinite bounds, and there are none
    if time_limit is not None:
        settings.time_limit = max(time_limit, 1e-3)
    triples = (len(b) - n_zero - n_nonneg) // 3
    cones = [clarabel.ZeroConeT(n_zero), clarabel.NonnegativeConeT(n_nonneg), *[clarabel.SecondOrderConeT(3)] * triples]
    P = sparse.csc_matrix((len(c), len(c)))
    return clarabel.DefaultSolver(P, c, sparse.csc_matrix(A), b, cones, settings).solve()


def dual_point(answer, n_zero, n_nonneg):
    """Return the answer's dual point z, moved the little that may be missing into the dual cone; zeros without one."""
    z = np.array(answer.z)
    if not np.isfinite(z).all():
        return np.zeros(len(z))
    linear = n_zero + n_nonneg
    z[n_zero:linear] = np.maximum(z[n_zero:linear], 0.0)
    head, x, y = z[linear::3], z[linear + 1 :: 3], z[linear + 2 :: 3]
    z[linear::3] = np.maximum(head, np.hypot(x, y) * (1 + 1e-15))
    return z


def claims_optimal(answer):
    """Tell whether the solver takes its point for an optimal one, to its own or to a looser tolerance."""
    return answer.status in (clarabel.SolverStatus.Solved, clarabel.SolverStatus.AlmostSolved)


def claims_infeasible(answer):
    """Tell whether the dual point is a certificate (still to be checked) that nothing is feasible."""
    return answer.status in (clarabel.SolverStatus.PrimalInfeasible, clarabel.SolverStatus.AlmostPrimalInfeasible)
