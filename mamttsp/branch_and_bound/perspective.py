"""The continuous relaxation of the MICP at one node of the search: only the edges left, each in its own times.

On edge e the times are written z_t = lo y + (hi - lo) u and z'_t = lo' y + (hi' - lo') u' with 0 <= u, u' <= y, where
[lo, hi] and [lo', hi'] are the edge's departure and arrival times by propagation. This replaces rows (23) and (24) by
tighter ones and keeps all numbers near one. Lengths are in units of R, so that l <= y. Where capacities bind, the load
q of an edge is written like the times, between its `load_limits`.
"""

import dataclasses
import math

import numpy as np

from ..conic_solver import claims_infeasible, dual_point, minimise
from .edge_entries import Entries
from .edge_rows import INTERVALS, EdgeRows, without_positions
from .loads import load_limits
from .successions import Successions

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
        self.successions = Successions(graph)
        self._take(without_positions(program))

    def add_cuts(self, cuts):
        """Demand, for each (edges, limit), a flow over `edges` of at most `limit` in every relaxation from now on."""
        self._take(self.program.with_cuts(cuts))

    def _take(self, program):
        self.program, self.rows, self.entries = program, EdgeRows(program), Entries.of(program, self.names)

    def relax(self, alive, times, time_limit=None):
        """Solve the relaxation on the edges in `alive` (|E|,) with their times (|E|, 4) and return a NodeRelaxation."""
        e = np.flatnonzero(alive)
        lo, width = self._intervals(e, times[e])
        n_more, *more = self.successions.rows(alive, times)
        entries = self.entries.on(alive).with_rows_of_flow(alive, n_more, *more)
        b = np.concatenate([self.program.b, np.zeros(n_more)])
        used = np.zeros(len(b), dtype=bool)
        used[entries.row] = True
        zero, nonneg, cone = self._rows(e, times[e])
        if (b[zero[~used[zero]]] != 0).any() or (b[nonneg[~used[nonneg]]] < 0).any():
            return NodeRelaxation(math.inf, np.zeros(len(alive)), np.zeros(len(alive)))  # 0 = 1, say
        nonneg = np.concatenate([nonneg, len(self.program.b) + np.arange(n_more)])
        zero, nonneg = zero[used[zero]], nonneg[used[nonneg]]
        A, n_signs = entries.matrix(np.concatenate([zero, nonneg]), cone, self.K, self.R, lo, width)
        b = np.concatenate([b[zero], b[nonneg], np.zeros(n_signs), b[cone]])
        return self._solve(alive, A, b, (len(zero), len(nonneg), n_more), n_signs, width > 0, time_limit)

    def _solve(self, alive, A, b, size, n_signs, wide, time_limit):
        """Minimise the sum of l over the rows (A, b): size = (zero, nonneg, how many of these are successions' rows),
        then the signs, then the cones."""
        e, (n_zero, n_nonneg, n_more) = np.flatnonzero(alive), size
        n, K, core = len(e), self.K, n_zero + n_nonneg
        c = np.zeros(A.shape[1])
        c[K + n : K + 2 * n] = 1.0
        size = n_zero, n_nonneg + n_signs
        answer = minimise(c, A, b, *size, self.threads, time_limit, refined=False)
        z = dual_point(answer, *size)
        z[core : core + n_signs] = 0.0
        self.successions.weigh(alive, z[core - n_more : core])
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
