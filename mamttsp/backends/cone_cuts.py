"""Tangents to the second-order cones of conic data: linear rows that every point of the cones satisfies."""

import numpy as np
from scipy import sparse

#: a cone counts as satisfied where its norm is this close to its bound, relative to one plus the norm
CONE_TOLERANCE = 1e-7
#: directions of the tangents to begin with, for cones in the plane
_FIRST_DIRECTIONS = 8


class ConeCuts:
    """The cones ||w_1, ..., w_k|| <= w_0 with w = b - A x of a ConicData, all of them of one size k + 1.

    A tangent in the unit direction g reads g . (w_1, ..., w_k) <= w_0.
    """

    def __init__(self, data):
        first = data.n_equal + data.n_linear
        sizes = set(data.cones)
        if len(sizes) != 1:
            raise ValueError(f"cones of one size are expected, found {sorted(sizes)}")
        self.A, self.b = data.A[first:], data.b[first:].reshape(len(data.cones), -1)
        self.heads = np.arange(len(data.cones)) * self.b.shape[1]

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
        for k in range(g.shape[1]):
            R = R - sparse.diags(g[:, k]) @ self.A[self.heads[cones] + k + 1]
            upper -= g[:, k] * self.b[cones, k + 1]
        return sparse.csr_matrix(R), upper
