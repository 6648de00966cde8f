"""A cvxpy problem as numbers: what a solver that cvxpy does not drive needs to know of it."""

import dataclasses

import cvxpy as cp
import numpy as np
from scipy import sparse


@dataclasses.dataclass(frozen=True, eq=False)
class ConicData:
    """min c x over lower <= x <= upper, integer where `integer`, with b - A x in a product of cones.

    The first `n_equal` rows are zero, the next `n_linear` at least zero, and the rest come in second-order cones of
    `cones` rows each, whose first row bounds the norm of the others.
    A constant term of the objective is left out: ours have none.
    """

    problem: cp.Problem
    c: np.ndarray
    A: sparse.csr_matrix
    b: np.ndarray
    n_equal: int
    n_linear: int
    cones: tuple
    lower: np.ndarray
    upper: np.ndarray
    integer: np.ndarray
    chain: object
    inverse_data: list

    def load(self, x):
        """Put the point x into the variables of the cvxpy problem."""
        raw = {"status": "optimal", "value": self.c @ x, "primal": np.asarray(x), "solve_time": 0.0, "num_iters": 0}
        self.problem.unpack_results(raw, self.chain, self.inverse_data)


def conic_data(problem):
    """Return the ConicData of a mixed-integer second-order cone problem."""
    data, chain, inverse_data = problem.get_problem_data(cp.SCIP)
    size, dims = len(data["c"]), data["dims"]
    binary, whole = (np.isin(np.arange(size), list(data[key])) for key in ("bool_vars_idx", "int_vars_idx"))
    lower, upper = (data[key] for key in ("lower_bounds", "upper_bounds"))
    lower = np.full(size, -np.inf) if lower is None else np.array(lower, dtype=float)
    upper = np.full(size, np.inf) if upper is None else np.array(upper, dtype=float)
    return ConicData(
        problem=problem,
        c=data["c"],
        A=sparse.csr_matrix(data["A"]),
        b=np.asarray(data["b"]),
        n_equal=dims.zero,
        n_linear=dims.nonneg,
        cones=tuple(dims.soc),
        lower=np.where(binary, np.maximum(lower, 0.0), lower),
        upper=np.where(binary, np.minimum(upper, 1.0), upper),
        integer=binary | whole,
        chain=chain,
        inverse_data=inverse_data,
    )
