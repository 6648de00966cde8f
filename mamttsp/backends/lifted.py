"""Conic data in the form that commercial solvers take, and the frame that their back ends share."""

import dataclasses
from typing import NamedTuple

import numpy as np
from scipy import sparse

from ..formulations.conic_form import conic_data
from ..options import Clock, Progress
from ..solution import known_length, relative_gap
from .answer import Answer


@dataclasses.dataclass(frozen=True, eq=False)
class Lifted:
    """min c x over A x = b in the first `n_equal` rows and the last, A x <= b in the `n_linear` between; bounds.

    Each cone is an index array of columns, x[cone[0]] >= ||x[cone[1:]]||. The first `n_original` columns are those of
    the conic data, the rest the slacks of its cones.
    """

    c: np.ndarray
    A: sparse.csr_matrix
    b: np.ndarray
    n_equal: int
    n_linear: int
    lower: np.ndarray
    upper: np.ndarray
    integer: np.ndarray
    cones: tuple
    n_original: int

    @property
    def senses(self):
        """(rows,) of "=" and "<"."""
        return np.array(["="] * self.n_equal + ["<"] * self.n_linear + ["="] * sum(map(len, self.cones)))


def lift(data):
    """Return the Lifted form of a ConicData."""
    n, q = len(data.c), sum(data.cones)
    linear = data.n_equal + data.n_linear
    slack = sparse.vstack([sparse.csr_matrix((linear, q)), sparse.identity(q)])
    starts = n + np.cumsum([0, *data.cones])[:-1]
    lower = np.concatenate([data.lower, np.full(q, -np.inf)])
    lower[starts] = 0.0
    return Lifted(
        c=np.concatenate([data.c, np.zeros(q)]),
        A=sparse.hstack([data.A, slack], format="csr"),
        b=data.b,
        n_equal=data.n_equal,
        n_linear=data.n_linear,
        lower=lower,
        upper=np.concatenate([data.upper, np.full(q, np.inf)]),
        integer=np.concatenate([data.integer, np.zeros(q, dtype=bool)]),
        cones=tuple(np.arange(start, start + size) for start, size in zip(starts, data.cones)),
        n_original=n,
    )


class Found(NamedTuple):
    """What a solver says of a Lifted program: status, its best point or None, bound, nodes, and its version."""

    status: str
    x: np.ndarray | None
    bound: float | None
    nodes: int | None
    solver: str


def solve_lifted(formulation, options, run):
    """Solve a cvxpy formulation with `run(lifted, options, clock) -> Found` and return the Answer."""
    clock = Clock(options.time_limit)
    data = conic_data(formulation.model.problem)
    found = run(lift(data), options, clock)
    objective = flow = None
    if found.x is not None:
        x = np.asarray(found.x)[: len(data.c)]
        data.load(x)
        objective, flow = known_length(data.c @ x), formulation.flow()
    return Answer(found.status, objective, known_length(found.bound), flow, found.nodes, clock.spent, found.solver)


def report(options, clock, objective, bound, nodes, phase):
    """Hand a running solve's numbers to `options.progress`, if there is one."""
    if options.progress:
        objective, bound = known_length(objective), known_length(bound)
        options.progress(Progress(clock.spent, objective, bound, relative_gap(objective, bound), nodes, phase))
