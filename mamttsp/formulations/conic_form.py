"""A formulation as numbers: the mixed-integer conic program that solvers are given, ours and others."""

import dataclasses
from collections.abc import Callable

import numpy as np
from scipy import sparse


@dataclasses.dataclass(frozen=True, eq=False)
class ConicProgram:
    """min c x over lower <= x <= upper, whole where `integer`, with b - A x in a product of cones.

    The first `n_zero` rows are zero, the next `n_nonneg` at least zero, and the rest come in triples (head, x, y) with
    head >= ||(x, y)||. columns: dict from a variable's name to the array of its columns, edges (or nodes) first; load:
    puts a point x into the variables of the model; read: returns the point of the values that they have. A constant
    term of the objective is left out: ours have none.
    """

    c: np.ndarray
    A: sparse.csr_array
    b: np.ndarray
    n_zero: int
    n_nonneg: int
    lower: np.ndarray
    upper: np.ndarray
    integer: np.ndarray
    columns: dict
    load: Callable
    read: Callable

    @property
    def n_linear(self):
        """The number of rows before the cones."""
        return self.n_zero + self.n_nonneg

    @property
    def senses(self):
        """(n_linear,) of "=" and "<", for A x = b and A x <= b."""
        return np.where(np.arange(self.n_linear) < self.n_zero, "=", "<")

    def relaxed(self):
        """Return the continuous relaxation, with the bounds of x among its rows.

        The upper bound 1 of `y` is left out: one unit of flow enters each cluster and is conserved, so it holds anyway.
        """
        unit, free = sparse.eye_array(len(self.c), format="csr"), np.full(len(self.c), np.inf)
        below, above = np.isfinite(self.lower), np.isfinite(self.upper)
        above[self.columns["y"].ravel()] = False
        rows = sparse.vstack([-unit[below], unit[above]], format="csr")
        program = self._with_rows(rows, np.concatenate([-self.lower[below], self.upper[above]]))
        return dataclasses.replace(program, lower=-free, upper=free, integer=np.zeros(len(self.c), dtype=bool))

    def with_cuts(self, cuts):
        """Return the program with a row y(edges) <= limit more for each (edges, limit)."""
        rows = np.zeros((len(cuts), len(self.c)))
        for row, (edges, _) in zip(rows, cuts):
            row[self.columns["y"][edges]] = 1.0
        return self._with_rows(sparse.csr_array(rows), [limit for _, limit in cuts])

    def _with_rows(self, rows, limits):
        """Return the program with rows x <= limits, after its other inequalities."""
        A = sparse.vstack([self.A[: self.n_linear], rows, self.A[self.n_linear :]], format="csr")
        b = np.concatenate([self.b[: self.n_linear], limits, self.b[self.n_linear :]])
        return dataclasses.replace(self, A=sparse.csr_array(A), b=b, n_nonneg=self.n_nonneg + len(limits))

    def lifted(self):
        """Return (program, cones) for solvers whose cones are of columns: cones (K, 3), each a triple (head, x, y).

        The program has no cones among its rows. It has a column more, at the end, for each row of one: its b - A x.
        """
        n, q = len(self.c), len(self.b) - self.n_linear
        zero, nonneg, conic = np.split(np.arange(len(self.b)), [self.n_zero, self.n_linear])
        blocks = [[self.A[zero], None], [self.A[conic], sparse.eye_array(q)], [self.A[nonneg], None]]
        lower = np.concatenate([self.lower, np.full(q, -np.inf)])
        lower[n::3] = 0.0
        program = ConicProgram(
            c=np.concatenate([self.c, np.zeros(q)]),
            A=sparse.csr_array(sparse.block_array(blocks, format="csr")),
            b=self.b[np.concatenate([zero, conic, nonneg])],
            n_zero=self.n_zero + q,
            n_nonneg=self.n_nonneg,
            lower=lower,
            upper=np.concatenate([self.upper, np.full(q, np.inf)]),
            integer=np.concatenate([self.integer, np.zeros(q, dtype=bool)]),
            columns=self.columns,
            load=lambda x: self.load(x[:n]),
            read=self._read_lifted,
        )
        return program, np.arange(n, n + q).reshape(-1, 3)

    def _read_lifted(self):
        x = self.read()
        return np.concatenate([x, (self.b - self.A @ x)[self.n_linear :]])
