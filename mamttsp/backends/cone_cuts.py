"""Tangents to the second-order cones of a conic program: linear rows that every point of the cones satisfies."""

import numpy as np
from scipy import sparse

#: a cone counts as satisfied where its norm is this close to its bound, relative to one plus the norm
CONE_TOLERANCE = 1e-7
#: directions of the tangents to begin with
_FIRST_DIRECTIONS = 8


class ConeCuts:
    """The cones ||(w_1, w_2)|| <= w_0 with w = b - A x of a ConicProgram.

    A tangent in the unit direction g reads g . (w_1, w_2) <= w_0.
    """

    def __init__(self, program):
        self.A, self.b = program.A[program.n_linear :], program.b[program.n_linear :].reshape(-1, 3)
        self.heads = 3 * np.arange(len(self.b))

    def first(self):
        """Return rows (R, upper) with R x <= upper for the tangents in evenly spread directions of the plane."""
        angles = np.arange(_FIRST_DIRECTIONS) * (2 * np.pi / _FIRST_DIRECTIONS)
        everyone = np.arange(len(self.heads))
        rows = [self._tangents(everyone, np.tile([np.cos(a), np.sin(a)], (len(everyone), 1))) for a in angles]
        return sparse.vstack([R for R, _ in rows], format="csr"), np.concatenate([upper for _, upper in rows])

    def violated(self, x):
        """Return rows (R, upper) for the tangents at x to the cones that x violates, most often none or a few."""
        w = self.b - (self.A @ x).reshape(self.b.shape)
        norms = np.linalg.norm(w[:, 1:], axis=1)
        cones = np.flatnonzero(norms > w[:, 0] + CONE_TOLERANCE * (1 + norms))
        return self._tangents(cones, w[cones, 1:] / norms[cones, None])

    def _tangents(self, cones, g):
        """g . (b_k - A_k x) <= b_0 - A_0 x, that is (A_0 - g . A_k) x <= b_0 - g . b_k."""
        R, upper = self.A[self.heads[cones]], self.b[cones, 0].copy()
        for k in (0, 1):
            R = R - sparse.diags(g[:, k]) @ self.A[self.heads[cones] + k + 1]
            upper -= g[:, k] * self.b[cones, k + 1]
        return sparse.csr_matrix(R), upper
