"""The restricted master problem: the linear set partitioning over the columns found so far, kept warm in HiGHS."""

from typing import NamedTuple

import highspy
import numpy as np

from ..silent_highs import SilentHighs

#: most that the master pays for a route that is needed only because so many are, in units
_NEEDED = 2.0
#: HiGHS's number for the primal simplex method
_PRIMAL = 4


class Duals(NamedTuple):
    """value: of the linear program; pi: (n,); sigma: (C,) <= 0; level: (J,) of the columns; outside: how much of the
    targets is served at the prices of the box."""

    value: float
    pi: np.ndarray
    sigma: np.ndarray
    level: np.ndarray
    outside: float


class RestrictedMaster:
    """Columns in rows: each target once, of each layer at most as many routes as the fleet has, in all as many as it
    needs, each subset-row cut at most once.

    Two artificial columns for each target hold its price in a box, and one holds down that of the routes needed. Costs
    are given in units of `unit`, so that HiGHS's tolerances fit.
    """

    def __init__(self, n_targets, fleet, n_cuts, unit):
        self.n, self.unit, self.fleet = n_targets, unit, fleet
        self.needed = int(fleet.least > 1)  # one route is always needed, and needs no row
        self._highs = highs = SilentHighs()
        # New columns leave a basis primal feasible; HiGHS's dual simplex was seen to go round for ever here.
        for name, value in (("output_flag", False), ("threads", 1), ("random_seed", 0), ("simplex_strategy", _PRIMAL)):
            highs.setOptionValue(name, value)
        index, none = np.zeros(0, np.int32), np.zeros(0)
        rows = [(1.0, 1.0)] * n_targets + [(-highspy.kHighsInf, float(count)) for count in fleet.counts]
        rows += [(float(fleet.least), highspy.kHighsInf)] * self.needed + [(-highspy.kHighsInf, 1.0)] * n_cuts
        for low, high in rows:
            highs.addRow(low, high, 0, index, none)
        columns = [(0.0, u, sign) for sign in (1.0, -1.0) for u in range(n_targets)]
        columns += [(_NEEDED, self._fixed - 1, 1.0)] * self.needed
        for cost, row, sign in columns:
            highs.addCol(cost, 0.0, highspy.kHighsInf, 1, np.array([row], np.int32), np.array([sign]))

    @property
    def _fixed(self):
        """How many rows there are beside those of cuts."""
        return self.n + len(self.fleet.counts) + self.needed

    def add(self, visits, agents, lengths, paid):
        """Add columns: visits (J, n), agents (J,) layers, lengths (J,), paid (J, C) how often each pays each cut."""
        of_layer = np.arange(len(self.fleet.counts)) == np.asarray(agents, dtype=int)[:, None]
        rows = np.hstack([visits, of_layer, np.ones((len(visits), self.needed)), paid])
        where, index = np.nonzero(rows)
        starts = np.searchsorted(where, np.arange(len(rows)))
        none, free = np.zeros(len(rows)), np.full(len(rows), highspy.kHighsInf)
        self._highs.addCols(
            len(rows), np.asarray(lengths) / self.unit, none, free, len(index), starts.astype(np.int32),
            index.astype(np.int32), rows[where, index],
        )  # fmt: skip

    def keep(self, which):
        """Drop all columns but those marked in which (J,)."""
        drop = np.flatnonzero(~which) + 2 * self.n + self.needed
        self._highs.deleteCols(len(drop), drop.astype(np.int32))

    def solve(self, centre, box, time_limit):
        """Return the Duals with pi within `box` of centre (n,), or None if HiGHS does not get there within the time
        limit in s."""
        highs, n = self._highs, self.n
        prices = np.r_[centre + box, box - centre] / self.unit
        highs.changeColsCost(2 * n, np.arange(2 * n, dtype=np.int32), prices)
        highs.setOptionValue("time_limit", highs.getRunTime() + max(min(time_limit, 1e6), 1e-3))
        highs.run()
        if highs.getModelStatus() != highspy.HighsModelStatus.kOptimal:
            return None
        answer = highs.getSolution()
        dual, level = np.array(answer.row_dual) * self.unit, np.array(answer.col_value)
        value = highs.getInfo().objective_function_value * self.unit
        return Duals(
            value, dual[:n], np.minimum(dual[self._fixed :], 0.0), level[2 * n + self.needed :], level[: 2 * n].sum()
        )
