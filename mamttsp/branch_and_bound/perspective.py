"""The continuous relaxation of the MICP at one node of the search: only the edges left, each in its own times.

On edge e the times are written z_t = lo y + (hi - lo) u and z'_t = lo' y + (hi' - lo') u' with 0 <= u, u' <= y, where
[lo, hi] and [lo', hi'] are the edge's departure and arrival times by propagation. This replaces rows (23) and (24) by
tighter ones and keeps all numbers near one. Lengths are in units of R, so that l <= y. Where capacities bind, the load
q of an edge is written like the times, between its `load_limits`.
"""

import dataclasses
import math

import numpy as np
from scipy import sparse

from ..conic_solver import claims_infeasible, dual_point, minimise
from .edge_rows import INTERVALS, EdgeRows, without_positions
from .loads import load_limits

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

    def __init__(self, program, graph, counts, threads=1):
        self.graph, self.counts, self.threads = graph, counts, threads
        self.R = graph.size or 1.0
        self.names = [name for name in INTERVALS if name in program.columns]
        self.K = len(counts)  # columns of alpha, the first ones
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
        n, core, signs, K = len(e), sum(size), _signs(len(e), wide, self.K), self.K
        c = np.zeros(A.shape[1])
        c[K + n : K + 2 * n] = 1.0
        A_full = sparse.vstack([A[:core], signs, A[core:]], format="csc")
        b_full = np.insert(b, core, np.zeros(signs.shape[0]))
        size = size[0], size[1] + signs.shape[0]
        answer = minimise(c, A_full, b_full, *size, self.threads, time_limit)
        z = np.delete(dual_point(answer, *size), np.s_[core : core + signs.shape[0]])
        flow, extra = np.zeros(len(self.graph.edges)), np.zeros(len(self.graph.edges))
        flow[e] = np.nan_to_num(answer.x[K : K + n])
        if claims_infeasible(answer) and self._proved(0 * c, A, b, z, wide)[0] > _ROUNDING * np.abs(b * z).sum():
            return NodeRelaxation(math.inf, flow, extra)
        bound, extra[e] = self._proved(c, A, b, z, wide)
        return NodeRelaxation(self.R * bound, flow, self.R * extra)

    def _proved(self, c, A, b, z, wide):
        """Return (bound, extra) that the duals z of the joint, speed and cone rows prove, in units of R.

        The residual r = c + A' z leaves r x, and what an edge adds to it is least at a corner of 0 <= l, u, u' <= y:
        y times the `extra` of the edge. At most n + m edges are flown.
        """
        n, K = wide.shape[1], self.K
        r = c + A.T @ z
        extra = r[K : K + n] + np.minimum(r[K + n : K + 2 * n], 0.0)
        for own, rest in zip(wide, np.split(r[K + 2 * n :], np.cumsum(wide.sum(axis=1))[:-1])):
            extra[own] += np.minimum(rest, 0.0)
        flown = self.graph.n_targets + self.counts.sum()
        fewest = 1 if K == 1 else 0  # (20)
        agents = np.minimum(r[:K] * fewest, r[:K] * self.counts).sum()
        bound = -b @ z + flown * min(extra.min(), 0.0) + agents
        return bound, extra

    def _intervals(self, e, times):
        """Return lo and width (one for each of `names`, |e|): departure and arrival times in s, loads."""
        g = self.graph
        nodes = g.edges[e].T
        lo, hi = times[:, 0::2].T, times[:, 1::2].T
        missing = np.maximum(_MIN_WIDTH * g.horizon - (hi - lo), 0.0)
        lo = np.maximum(lo - missing, g.t_lo[nodes])
        hi = np.minimum(hi + missing, g.t_hi[nodes])
        if "q" in self.names:
            least, most = load_limits(g)[:, e]
            lo, hi = np.vstack([lo, least]), np.vstack([hi, most])
        return lo, hi - lo

    def _columns(self, e, lo, width):
        """Return the matrix that gives the program's columns from alpha, y, l and the u of each width above 0."""
        columns, n, K = self.program.columns, len(e), self.K
        own = K + np.arange(n)
        into = [np.atleast_1d(columns["alpha"]), columns["l"][e], columns["y"][e]]
        of, by = [np.arange(K), own + n, own], [np.ones(K), np.full(n, self.R), np.ones(n)]
        size = K + 2 * n
        for name, least, wide in zip(self.names, lo, width):
            u = np.flatnonzero(wide > 0)
            into += [columns[name][e], columns[name][e[u]]]
            of += [own, size + np.arange(len(u))]
            by += [least, wide[u]]
            size += len(u)
        into, of, by = (np.concatenate(part) for part in (into, of, by))
        return sparse.csr_array((by, (into, of)), shape=(len(self.program.c), size))

    def _rows(self, e, times):
        """Return the rows that join edges, zero and at least zero, with the speed rows that matter, and the cones."""
        g = self.graph
        i, j = g.edges[e].T
        leave, arrive = times[:, 1], times[:, 2]
        gap = g.p_lo[j] + (arrive - g.t_lo[j])[:, None] * g.v[j] - g.p_lo[i] - (leave - g.t_lo[i])[:, None] * g.v[i]
        # Movers are slower than agents, so if the last departure makes the first arrival, the speed never matters.
        binding = np.hypot(*gap.T) > g.speeds[g.layer[i]] * (arrive - leave)
        nonneg = np.concatenate([self.rows.joint, self.rows.speed[e[binding]]])
        return self.rows.zero, nonneg, (self.rows.cone[e][:, None] + np.arange(3)).ravel()


def _signs(n, wide, K):
    """Return the rows of u >= 0 and u <= y for each interval of each edge, and y >= 0 where an edge has no u."""
    size = wide.sum()
    owner = np.concatenate([np.flatnonzero(w) for w in wide])
    bare = np.flatnonzero(~wide.any(axis=0))
    unit = sparse.eye_array(size, format="csr")
    above = sparse.csr_array((np.ones(size), (np.arange(size), K + owner)), shape=(size, K + 2 * n))
    y = sparse.csr_array((-np.ones(len(bare)), (np.arange(len(bare)), K + bare)), shape=(len(bare), K + 2 * n))
    return sparse.block_array([[None, -unit], [-above, unit], [y, None]], format="csr") if size else y
