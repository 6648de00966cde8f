"""The continuous relaxation of the MICP at one node of the search: only the edges left, each in its own times.

On edge e the times are written z_t = lo y + (hi - lo) u and z'_t = lo' y + (hi' - lo') u' with 0 <= u, u' <= y, where
[lo, hi] and [lo', hi'] are the edge's departure and arrival times by propagation. This replaces rows (23) and (24) by
tighter ones and keeps all numbers near one. Lengths are in units of R, so that l <= y.
"""

import dataclasses
import math

import numpy as np
from scipy import sparse

from ..conic_solver import claims_infeasible, dual_point, minimise
from .edge_rows import EdgeRows, without_positions

#: least width of an interval of time, as a fraction of the horizon, so that the relaxation has an interior
_MIN_WIDTH = 1e-7
#: what rounding may do to a sum, as a fraction of its terms
_ROUNDING = 1e-9


@dataclasses.dataclass(frozen=True, eq=False)
class NodeRelaxation:
    """A solved relaxation.

    bound: proved lower bound in units, infinity if nothing is feasible; y: (|E|,) flow, 0 where an edge is gone; extra:
    (|E|,) by how much the bound rises, at least, if the edge is flown.
    """

    bound: float
    y: np.ndarray
    extra: np.ndarray


class Perspective:
    """The MICP's relaxed ConicProgram, ready for relaxations on fewer and fewer edges."""

    def __init__(self, program, graph, n_agents, threads=1):
        self.graph, self.n_agents, self.threads = graph, n_agents, threads
        self.R = graph.size or 1.0
        self._take(without_positions(program))

    def add_cuts(self, cuts):
        """Demand, for each (edges, limit), a flow over `edges` of at most `limit` in every relaxation from now on."""
        self._take(self.program.with_cuts(cuts))

    def _take(self, program):
        self.program, self.rows = program, EdgeRows(program)

    def relax(self, alive, times, time_limit=None):
        """Solve the relaxation on the edges in `alive` (|E|,) with their times (|E|, 4) and return a NodeRelaxation."""
        e = np.flatnonzero(alive)
        lo, width = self._intervals(e, times[e])
        columns = self._columns(e, lo, width)
        A = self.program.A @ columns
        used = np.diff(A.indptr) > 0
        zero, nonneg, cone = self._rows(e, times[e])
        if (self.program.b[zero[~used[zero]]] != 0).any() or (self.program.b[nonneg[~used[nonneg]]] < 0).any():
            return NodeRelaxation(math.inf, np.zeros(len(alive)), np.zeros(len(alive)))  # 0 = 1, say
        zero, nonneg = zero[used[zero]], nonneg[used[nonneg]]
        rows = np.concatenate([zero, nonneg, cone])
        return self._solve(e, A[rows], self.program.b[rows], (len(zero), len(nonneg)), width > 0, time_limit)

    def _solve(self, e, A, b, size, wide, time_limit):
        """Minimise the sum of l over the rows (A, b), of which size = (zero, nonneg) come before the cones."""
        n, core, signs = len(e), sum(size), _signs(len(e), wide)
        c = np.zeros(A.shape[1])
        c[1 + n : 1 + 2 * n] = 1.0
        A_full = sparse.vstack([A[:core], signs, A[core:]], format="csc")
        b_full = np.insert(b, core, np.zeros(signs.shape[0]))
        size = size[0], size[1] + signs.shape[0]
        answer = minimise(c, A_full, b_full, *size, self.threads, time_limit)
        z = np.delete(dual_point(answer, *size), np.s_[core : core + signs.shape[0]])
        flow, extra = np.zeros(len(self.graph.edges)), np.zeros(len(self.graph.edges))
        flow[e] = np.nan_to_num(answer.x[1 : 1 + n])
        if claims_infeasible(answer) and self._proved(0 * c, A, b, z, wide)[0] > _ROUNDING * np.abs(b * z).sum():
            return NodeRelaxation(math.inf, flow, extra)
        bound, extra[e] = self._proved(c, A, b, z, wide)
        return NodeRelaxation(self.R * bound, flow, self.R * extra)

    def _proved(self, c, A, b, z, wide):
        """Return (bound, extra) that the duals z of the joint, speed and cone rows prove, in units of R.

        The residual r = c + A' z leaves r x, and what an edge adds to it is least at a corner of 0 <= l, u, u' <= y:
        y times the `extra` of the edge. At most n + m edges are flown.
        """
        n = wide.shape[1]
        r = c + A.T @ z
        extra = r[1 : 1 + n] + np.minimum(r[1 + n : 1 + 2 * n], 0.0)
        extra[wide[0]] += np.minimum(r[1 + 2 * n : 1 + 2 * n + wide[0].sum()], 0.0)
        extra[wide[1]] += np.minimum(r[1 + 2 * n + wide[0].sum() :], 0.0)
        flown = self.graph.n_targets + self.n_agents
        bound = -b @ z + flown * min(extra.min(), 0.0) + min(r[0], self.n_agents * r[0])
        return bound, extra

    def _intervals(self, e, times):
        """Return lo (2, |e|) and width (2, |e|) of the departure and arrival times, in s."""
        g = self.graph
        nodes = g.edges[e].T
        lo, hi = times[:, 0::2].T, times[:, 1::2].T
        missing = np.maximum(_MIN_WIDTH * g.horizon - (hi - lo), 0.0)
        lo = np.maximum(lo - missing, g.t_lo[nodes])
        hi = np.minimum(hi + missing, g.t_hi[nodes])
        return lo, hi - lo

    def _columns(self, e, lo, width):
        """Return the matrix that gives the program's columns from alpha, y, l and the u and u' of widths above 0."""
        columns, n = self.program.columns, len(e)
        y, l, z, z_prime = (columns[name][e] for name in ("y", "l", "z_t", "z_t_prime"))
        wide = [np.flatnonzero(w > 0) for w in width]
        own = 1 + np.arange(n)
        u = 1 + 2 * n + np.arange(len(wide[0]))
        u_prime = 1 + 2 * n + len(wide[0]) + np.arange(len(wide[1]))
        into = [np.atleast_1d(columns["alpha"]), y, z, z_prime, l, z[wide[0]], z_prime[wide[1]]]
        of = [[0], own, own, own, own + n, u, u_prime]
        by = [[1.0], np.ones(n), lo[0], lo[1], np.full(n, self.R), width[0][wide[0]], width[1][wide[1]]]
        into, of, by = (np.concatenate(part) for part in (into, of, by))
        shape = len(self.program.c), 1 + 2 * n + len(u) + len(u_prime)
        return sparse.csr_array((by, (into, of)), shape=shape)

    def _rows(self, e, times):
        """Return the rows that join edges, zero and at least zero, with the speed rows that matter, and the cones."""
        g = self.graph
        i, j = g.edges[e].T
        leave, arrive = times[:, 1], times[:, 2]
        gap = g.p_lo[j] + (arrive - g.t_lo[j])[:, None] * g.v[j] - g.p_lo[i] - (leave - g.t_lo[i])[:, None] * g.v[i]
        # Movers are slower than agents, so if the last departure makes the first arrival, the speed never matters.
        binding = np.hypot(*gap.T) > g.max_speed * (arrive - leave)
        nonneg = np.concatenate([self.rows.joint, self.rows.speed[e[binding]]])
        return self.rows.zero, nonneg, (self.rows.cone[e][:, None] + np.arange(3)).ravel()


def _signs(n, wide):
    """Return the rows of u >= 0 and u <= y for both ends of each edge, and y >= 0 where an edge has no u."""
    size = wide.sum()
    owner = np.concatenate([np.flatnonzero(w) for w in wide])
    bare = np.flatnonzero(~wide.any(axis=0))
    unit = sparse.eye_array(size, format="csr")
    above = sparse.csr_array((np.ones(size), (np.arange(size), 1 + owner)), shape=(size, 1 + 2 * n))
    y = sparse.csr_array((-np.ones(len(bare)), (np.arange(len(bare)), 1 + bare)), shape=(len(bare), 1 + 2 * n))
    return sparse.block_array([[None, -unit], [-above, unit], [y, None]], format="csr") if size else y
