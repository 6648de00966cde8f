"""A mixed-integer conic program in standard form, from a model of either modeler."""

import dataclasses

import cvxpy as cp
import numpy as np
from pyomo.environ import Var
from pyomo.opt import WriterFactory
from pyomo.repn import generate_standard_repn
from scipy import sparse


@dataclasses.dataclass(frozen=True, eq=False)
class ConicProgram:
    """min c x with b - A x in a product of cones: `n_zero` rows zero, `n_nonneg` at least zero, the rest in triples.

    Each triple (head, x, y) has head >= ||(x, y)||. columns: dict from a variable's name to the array of its columns,
    edges (or nodes) first. Columns of `y` are binary; their upper bound 1 is left out: one unit of flow enters each
    cluster and is conserved, so it holds in the continuous relaxation too.
    """

    c: np.ndarray
    A: sparse.csr_array
    b: np.ndarray
    n_zero: int
    n_nonneg: int
    columns: dict

    def with_cuts(self, cuts):
        """Return the program with a row y(edges) <= limit more for each (edges, limit)."""
        rows = np.zeros((len(cuts), len(self.c)))
        for row, (edges, _) in zip(rows, cuts):
            row[self.columns["y"][edges]] = 1.0
        linear = self.n_zero + self.n_nonneg
        A = sparse.vstack([self.A[:linear], sparse.csr_array(rows), self.A[linear:]], format="csr")
        b = np.concatenate([self.b[:linear], [limit for _, limit in cuts], self.b[linear:]])
        return dataclasses.replace(self, A=A, b=b, n_nonneg=self.n_nonneg + len(cuts))


def conic_program(formulation):
    """Return the ConicProgram of a formulation (baseline or MICP), with the cuts that it has by now."""
    return _from_cvxpy(formulation.model) if formulation.modeler == "cvxpy" else _from_pyomo(formulation.model)


def _from_cvxpy(model):
    data = conic_data(model.problem)
    columns = _columns_of(data)
    bounds = _bound_rows(data.lower, data.upper, columns["y"])
    linear = data.n_equal + data.n_linear
    A = sparse.vstack([data.A[:linear], bounds[0], data.A[linear:]], format="csr")
    b = np.concatenate([data.b[:linear], bounds[1], data.b[linear:]])
    return ConicProgram(data.c, sparse.csr_array(A), b, data.n_equal, data.n_linear + len(bounds[1]), columns)


def _columns_of(data):
    """Load the numbers of the columns into the variables, and read there which variable has which."""
    data.load(np.arange(len(data.c), dtype=float))
    columns = {}
    for variable in data.problem.variables():
        columns[variable.name()] = np.rint(variable.value).astype(int)
        variable.value = None
    return columns


def _from_pyomo(model):
    """The norm constraints are compiled apart: Pyomo's standard form is for linear rows."""
    model.norm.deactivate()
    try:
        form = WriterFactory("compile_standard_form").write(model, mixed_form=True)
    finally:
        model.norm.activate()
    number = {id(variable): k for k, variable in enumerate(form.columns)}
    columns = {
        component.local_name: np.array([number[id(variable)] for variable in component.values()])
        for component in model.component_objects(Var)
    }
    kind = np.array([row.bound_type for row in form.rows])
    A, rhs = sparse.csr_array(form.A), np.asarray(form.rhs, dtype=float)
    sign = np.where(kind == -1, -1.0, 1.0)  # a row of kind -1 is A x >= rhs
    A, rhs = sparse.csr_array(sparse.diags_array(sign) @ A), sign * rhs
    lower, upper = np.array([(x.lb, x.ub) for x in form.columns], dtype=float).T  # None becomes NaN
    bounds = _bound_rows(lower, upper, columns["y"])
    cones = _cone_rows(model.norm, number, A.shape[1])
    A = sparse.vstack([A[kind == 0], A[kind != 0], bounds[0], cones], format="csr")
    b = np.concatenate([rhs[kind == 0], rhs[kind != 0], bounds[1], np.zeros(cones.shape[0])])
    c = np.asarray(form.c.todense(), dtype=float).ravel()
    equations = int((kind == 0).sum())
    return ConicProgram(c, sparse.csr_array(A), b, equations, len(kind) - equations + len(bounds[1]), columns)


def _cone_rows(norm, number, width):
    """Return the rows of x^2 + y^2 - head^2 <= 0, three for each constraint: head, x, y, each times -1."""
    picked = []
    for row in norm.values():
        form = generate_standard_repn(row.body)
        order = np.argsort(form.quadratic_coefs, kind="stable")  # the head has the negative coefficient
        picked += [number[id(form.quadratic_vars[k][0])] for k in order]
    size = len(picked)
    return sparse.csr_array((-np.ones(size), (np.arange(size), picked)), shape=(size, width))


def _bound_rows(lower, upper, binary):
    """Return (rows, right sides) of the finite bounds of the columns, but for y <= 1."""
    unit = sparse.eye_array(len(lower), format="csr")
    above = np.isfinite(upper)
    above[binary.ravel()] = False
    below = np.isfinite(lower)
    return sparse.vstack([-unit[below], unit[above]]), np.concatenate([-lower[below], upper[above]])


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
