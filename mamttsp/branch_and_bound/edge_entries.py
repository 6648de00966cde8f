"""The entries of the MICP's program by edges, and the matrix of a relaxation on some of them, put together at once.

At every node of the search a matrix is made for the edges that are left. As one list of entries that is sorted once, it
takes a fraction of the time of products and stacks of sparse matrices.
"""

import dataclasses

import numpy as np
from scipy import sparse

_ALPHA, _L, _Y, _FIRST = range(4)  # kinds of variables; from _FIRST on the intervals


@dataclasses.dataclass(frozen=True, eq=False)
class Entries:
    """Entries of a program without positions, side by side.

    n_rows: of the program, of which some may have no entry; row: of the program; kind: of the variable; owner: which
    of that kind, an edge or, of alpha, a layer; value: the number.
    """

    n_rows: int
    row: np.ndarray
    kind: np.ndarray
    owner: np.ndarray
    value: np.ndarray

    @staticmethod
    def of(program, names):
        """Return the entries of a program whose intervals have these names."""
        A = program.A.tocoo()
        kind, owner = np.full(A.shape[1], -1), np.zeros(A.shape[1], dtype=int)
        for k, name in enumerate(("alpha", "l", "y", *names)):
            columns = np.atleast_1d(program.columns[name])
            kind[columns], owner[columns] = k, np.arange(len(columns))
        row, column = A.row, A.col  # what scipy 1.12 has too
        held = kind[column] >= 0
        return Entries(A.shape[0], row[held], kind[column[held]], owner[column[held]], A.data[held])

    def on(self, alive):
        """Return the entries of alpha and of the edges in `alive` (|E|,), which are numbered anew."""
        place = np.cumsum(alive) - 1
        held = (self.kind == _ALPHA) | alive[self.owner % len(alive)]
        row, kind, owner = self.row[held], self.kind[held], self.owner[held]
        owner = np.where(kind == _ALPHA, owner, place[owner % len(alive)])
        return Entries(self.n_rows, row, kind, owner, self.value[held])

    def with_rows_of_flow(self, alive, number, row, edge, value):
        """Return the entries, on the edges in `alive`, with so many rows more, of y alone; row: from 0 on."""
        place = np.cumsum(alive) - 1
        return Entries(
            self.n_rows + number,
            np.concatenate([self.row, self.n_rows + row]),
            np.concatenate([self.kind, np.full(len(row), _Y)]),
            np.concatenate([self.owner, place[edge]]),
            np.concatenate([self.value, value]),
        )

    def matrix(self, core, cones, K, R, lo, width):
        """Return (A, number): the rows `core` and `cones` of the program, with the signs, so many, between them.

        Columns: alpha (K), y, l in units of R, and for each width (intervals, n) above 0 its u, by lo y + width u.
        Signs: u >= 0 and u <= y, and y >= 0 where an edge has no u.
        """
        n, wide = lo.shape[1], width > 0
        u = np.full(wide.shape, -1)
        u[wide] = K + 2 * n + np.arange(wide.sum())
        signs = _signs(u, wide, K, len(core))
        place = np.full(self.n_rows, -1)
        place[core] = np.arange(len(core))
        place[cones] = len(core) + signs.number + np.arange(len(cones))
        held = place[self.row] >= 0
        row, kind, owner, value = place[self.row[held]], self.kind[held], self.owner[held], self.value[held]
        inside = kind >= _FIRST
        scale, own = np.ones(len(row)), K + owner
        own[kind == _ALPHA] -= K
        own[kind == _L] += n
        scale[kind == _L] = R
        scale[inside] = lo[kind[inside] - _FIRST, owner[inside]]
        also = np.flatnonzero(inside)
        also = also[wide[kind[also] - _FIRST, owner[also]]]
        interval = kind[also] - _FIRST, owner[also]
        rows = np.concatenate([row, row[also], signs.row])
        columns = np.concatenate([own, u[interval], signs.column])
        values = np.concatenate([value * scale, value[also] * width[interval], signs.value])
        shape = len(core) + signs.number + len(cones), K + 2 * n + int(wide.sum())
        return sparse.csc_array((values, (rows, columns)), shape=shape), signs.number


@dataclasses.dataclass(frozen=True, eq=False)
class _Signs:
    number: int
    row: np.ndarray
    column: np.ndarray
    value: np.ndarray


def _signs(u, wide, K, first):
    """Return the rows from number `first` on that say the signs; u: (intervals, n) columns."""
    size = wide.sum()
    of_u, of_y = u[wide], K + np.nonzero(wide)[1]
    bare = K + np.flatnonzero(~wide.any(axis=0))
    row = first + np.arange(2 * size + len(bare))
    rows = np.concatenate([row[: 2 * size], row[size : 2 * size], row[2 * size :]])
    columns = np.concatenate([of_u, of_u, of_y, bare])
    values = np.repeat([-1.0, 1.0, -1.0, -1.0], [size, size, size, len(bare)])
    return _Signs(len(row), rows, columns, values)
