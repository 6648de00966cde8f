"""Where a search stands: its incumbent, its proved bound, and the gap between them."""

import math

from ..solution import relative_gap
from .incumbent import Incumbent

#: every bound is lowered by this share, far above the rounding errors of the sums it comes from
_SAFETY = 1e-9
#: lengths below this share of the area's size count as nothing, for optima of 0
_NEGLIGIBLE = 1e-8


class Standing:
    """incumbent: the best tours; bound: proved lower bound, infinite if nothing below the cutoff can be; both hold at
    every moment.

    gap: relative gap to close; cutoff: value from which solutions are of no interest; `bound` may then stop there.
    """

    def __init__(self, graph, n_agents, gap, cutoff=math.inf):
        self.incumbent, self.bound, self.cutoff, self._gap = Incumbent(graph, n_agents), 0.0, cutoff, gap
        self._negligible = _NEGLIGIBLE * graph.size

    @property
    def upper(self):
        return min(self.incumbent.objective, self.cutoff)

    @property
    def limit(self):
        """Solutions at or above this value need not be looked at: the gap may stay that wide."""
        return self.upper * (1.0 - 0.5 * self._gap) - 0.5 * self._negligible

    def closed(self):
        return self.bound >= self.upper * (1.0 - self._gap) - self._negligible

    def raise_bound(self, bound):
        self.bound = min(max(self.bound, bound * (1.0 - _SAFETY)), self.upper)

    def figures(self):
        """Return (objective, bound, relative gap), the objective None without tours."""
        objective = None if math.isinf(self.incumbent.objective) else self.incumbent.objective
        return objective, self.bound, relative_gap(objective, self.bound)
