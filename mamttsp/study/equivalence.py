"""Tours, and cycles if there are any, carried into all three formulations at once."""

from typing import NamedTuple

from ..formulations.equations import EQUATIONS
from ..formulations.formulation import build_formulation
from ..formulations.points import assign
from ..formulations.residuals import objective, residuals


class Carried(NamedTuple):
    """A point of one formulation: its objective in units, and {family: largest violation} as `residuals` has it."""

    objective: float
    residuals: dict

    @property
    def worst(self):
        """The largest violation of all."""
        return max(self.residuals.values())


def carry(graph, n_agents, tours, cycles=()):
    """Return {method: Carried} for the tours and cycles in each formulation, built with Pyomo; see `assign`."""
    found = {}
    for method in EQUATIONS:
        formulation = build_formulation(method, "pyomo", graph, n_agents)
        assign(formulation, tours, cycles)
        found[method] = Carried(objective(formulation.model), residuals(formulation.model))
    return found
