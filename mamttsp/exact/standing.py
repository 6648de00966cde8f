"""Where a search stands: its incumbent, its proved bound, and the gap between them."""

import math

from ..solution import relative_gap
from .incumbent import Incumbent

#: every bound is lowered by this share, far above the rounding errors of the sums it comes from
_SAFETY = 1e-9
#: lengths below this share of the area's size count as nothing, for optima of 0
_NEGLIGIBLE = 1e-8


class Standing:
    """incumbent: the best tours; bound: proved lower bound; both hold at every moment. gap: relative gap to close.

    No agent flies further than v_max T, so no solution is longer than the sum of that; without tours a bound that
    reaches it proves that there is none.
    """

    def __init__(self, graph, fleet, gap):
        self.incumbent, self.bound, self._gap = Incumbent(graph, fleet), 0.0, gap
        self._longest = self.incumbent.longest * (1.0 + 1e-6)
        self._negligible = _NEGLIGIBLE * graph.size

    @property
    def upper(self):
        return min(self.incumbent.objective, self._longest)

    @property
    def limit(self):
        """Solutions at or above this value need not be looked at: the gap may stay that wide."""
        if not self.incumbent.routes:
            return self._longest
        return self.upper * (1.0 - 0.5 * self._gap) - 0.5 * self._negligible

    def closed(self):
        if not self.incumbent.routes:
            return self.bound >= self._longest
        return self.bound >= self.upper * (1.0 - self._gap) - self._negligible

    @property
    def infeasible(self):
        return self.closed() and not self.incumbent.routes

    def raise_bound(self, bound):
        """Take a bound that holds for all solutions below the limit: above that it says nothing."""
        capped = min(bound, self.limit)
        safe = capped if capped == self.limit else capped - _SAFETY * abs(capped)
        self.bound = float(min(max(self.bound, safe), self.upper))

    def figures(self):
        """Return (objective, bound, relative gap), the objective None without tours."""
        objective = None if math.isinf(self.incumbent.objective) else self.incumbent.objective
        return objective, self.bound, relative_gap(objective, self.bound)
