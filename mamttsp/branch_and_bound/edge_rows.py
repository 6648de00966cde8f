"""The MICP's conic program by edges: positions put in for their names, and which row is which edge's."""

import dataclasses

import numpy as np
from scipy import sparse

#: variables of an edge that lie in an interval times y: (23), (24), and the load where capacities bind
INTERVALS = ("z_t", "z_t_prime", "q")


def without_positions(program):
    """Return the program without l_xy, z_p and z'_p: rows (28), (25) and (26) define them and are put in for them."""
    for name in ("l_xy", "z_p", "z_p_prime"):
        program = _substitute(program, program.columns[name].ravel())
    return program


def _substitute(program, columns):
    """Put the equations that define `columns`, one each, in for them; the columns stay, empty."""
    A, b = program.A, program.b
    picked = sparse.csc_array(A[: program.n_zero])[:, columns]
    rows = picked.indices  # column k occurs in the one equation rows[k], with the coefficient picked.data[k]
    defined = sparse.diags_array(1.0 / picked.data) @ A[rows], b[rows] / picked.data
    others = np.setdiff1d(np.arange(len(b)), rows)
    used = sparse.csr_array(A[others][:, columns])
    A = sparse.csr_array(A[others] - used @ defined[0])
    A.data[np.abs(A.data) < 1e-12] = 0.0  # what cancels leaves rounding behind
    A.eliminate_zeros()
    return dataclasses.replace(program, A=A, b=b[others] - used @ defined[1], n_zero=program.n_zero - len(rows))


class EdgeRows:
    """The rows of a program without positions, by what they join.

    zero, joint: indices of the equations and of the inequalities that join edges (flow, times, cuts); speed: (|E|,)
    the row (27) of each edge; cone: (|E|,) the first of the three rows (29) of each edge. Rows (23) and (24), loads'
    too, and the signs of y and l are nowhere: a Perspective has its own.
    """

    def __init__(self, program):
        A, columns = program.A, program.columns
        linear = program.n_zero + program.n_nonneg
        n_edges = len(columns["y"])
        edge = np.full(A.shape[1], -1)
        for name in ("y", "l", *INTERVALS):
            if name in columns:
                edge[columns[name]] = np.arange(n_edges)
        touched = np.diff(A.indptr)
        entry = np.repeat(np.arange(len(program.b)), touched)  # the row of each entry of A
        first, last = np.full(len(program.b), n_edges), np.full(len(program.b), -1)
        np.minimum.at(first, entry, edge[A.indices])
        np.maximum.at(last, entry, edge[A.indices])
        with_l = np.isin(np.arange(len(program.b)), entry[np.isin(A.indices, columns["l"])])
        own = (first == last) & (first >= 0) & (program.b == 0)
        row = np.arange(len(program.b))
        self.zero = row[: program.n_zero]
        inequality = (row >= program.n_zero) & (row < linear)
        self.joint = row[inequality & ~own]
        speed = row[inequality & own & with_l & (touched > 1)]
        self.speed, self.cone = np.empty(n_edges, dtype=int), np.empty(n_edges, dtype=int)
        self.speed[first[speed]] = speed
        self.cone[first[linear::3]] = row[linear::3]
