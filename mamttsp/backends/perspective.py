"""The continuous relaxation of the MICP at one node of the search: only the edges left, each in its own times.

On edge e the times are written z_t = lo y + (hi - lo) u and z'_t = lo' y + (hi' - lo') u' with 0 <= u, u' <= y, where
[lo, hi] and [lo', hi'] are the edge's departure and arrival times by propagation. This replaces rows (23) and (24) by
tighter ones and keeps all numbers near one. Lengths are in units of R, so l <= y.
"""

import dataclasses
import math

import clarabel
import numpy as np
from scipy import sparse

from .certificate import infeasible, lower_bound, project
from .clarabel_settings import settings
from .edge_rows import EdgeRows, without_positions

#: least width of an interval of time, as a fraction of the horizon, so that the relaxation has an interior
_MIN_WIDTH = 1e-7


@dataclasses.dataclass(frozen=True, eq=False)
class Relaxed:
    """A solved relaxation.

    bound: proved lower bound in units, infinity if it is proved infeasible; y: (|E|,) flow, 0 where an edge is gone;
    extra: (|E|,) by how much the bound rises, at least, if the edge is flown.
    """

    bound: float
    y: np.ndarray
    extra: np.ndarray


class Perspective:
    """The MICP as a ConicProgram, ready for relaxations on fewer and fewer edges."""

    def __init__(self, program, graph, n_agents, threads=1):
        self.graph, self.n_agents = graph, n_agents
        self.settings = settings(threads)
        self.program = without_positions(program)
        self.rows = EdgeRows(self.program, len(graph.edges))

    def add_cut(self, edges, limit):
        """Demand that the flow over `edges` is at most `limit`, in every relaxation from now on."""
        self.program = self.program.with_cut(edges, limit)
        self.rows = EdgeRows(self.program, len(self.graph.edges))

    def relax(self, alive, times, time_limit=math.inf):
        """Solve the relaxation on the edges in `alive` (|E|,) with their times (|E|, 4) and return a Relaxed."""
        e = np.flatnonzero(alive)
        starts, widths = self._intervals(e, times[e])
        columns = self._columns(e, starts, widths)
        rows = self._rows(e, times[e], columns)
"""
