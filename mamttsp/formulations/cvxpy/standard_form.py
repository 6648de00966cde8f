"""A cvxpy program as a ConicProgram."""

import cvxpy as cp
import numpy as np
from scipy import sparse

from ..conic_form import ConicProgram


def standard_form(model):
    """Return the ConicProgram of a Program (baseline or MICP), with the cuts that it has by now."""
    problem = model.problem
    data, chain, inverse_data = problem.get_problem_data(cp.SCIP)
    size, dims = len(data["c"]), data["dims"]
    if set(dims.soc) != {3}:
        raise ValueError(f"cones in the plane are expected, three rows each, found {sorted(set(dims.soc))}")
    binary, whole = (np.isin(np.arange(size), list(data[key])) for key in ("bool_vars_idx", "int_vars_idx"))
    lower, upper = (data.get(key) for key in ("lower_bounds", "upper_bounds"))
    lower = np.full(size, -np.inf) if lower is None else np.array(lower, dtype=float)
    upper = np.full(size, np.inf) if upper is None else np.array(upper, dtype=float)

    def load(x):
        point = {"status": "optimal", "value": data["c"] @ x, "primal": np.asarray(x)}
        problem.unpack_results(point | {"solve_time": 0.0, "num_iters": 0}, chain, inverse_data)

    columns = _columns(problem, load, size) | {"y": np.flatnonzero(binary).reshape(model.y.shape, order="F")}

    def read():
        x = np.zeros(size)
        for variable in problem.variables():
            x[columns[variable.name()]] = variable.value
        return x

    return ConicProgram(
        c=data["c"],
        A=sparse.csr_array(data["A"]),
        b=np.asarray(data["b"]),
        n_zero=dims.zero,
        n_nonneg=dims.nonneg,
        lower=np.where(binary, np.maximum(lower, 0.0), lower),
        upper=np.where(binary, np.minimum(upper, 1.0), upper),
        integer=binary | whole,
        columns=columns,
        load=load,
        read=read,
    )


def _columns(problem, load, size):
    """Load the numbers of the columns into the variables, and read there which variable has which.

    Not so for a boolean variable, whose values cvxpy may clip to 0 and 1.
    """
    load(np.arange(size, dtype=float))
    columns = {}
    for variable in problem.variables():
        columns[variable.name()] = np.rint(variable.value).astype(int)
        variable.value = None
    return columns
