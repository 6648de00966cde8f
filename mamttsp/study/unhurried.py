"""Column generation as the exact solver does it, without its haste: whole evaluations only, and no arc dropped.

So the bounds are those of the pieces, ng-sets and cuts alone, and can be compared.
"""

import numpy as np

from ..exact.column_generation import ColumnGeneration
from ..exact.evaluation import first_network
from ..exact.fleet import Fleet
from ..exact.parameters import Parameters
from ..exact.pieces import even_cuts
from ..options import Watch


def column_generation(graph, ng_size, width):
    """Return the ColumnGeneration of a graph over pieces of at most `width` s, each target remembering `ng_size` others
    at first."""
    parameters = Parameters(ng_size=ng_size, few_entries=(), dropped=0.0, converged=0.02)
    network = first_network(graph, even_cuts(graph, graph.V_seg, width), range(graph.n_targets))
    prices = np.full(graph.n_targets, graph.size / graph.n_targets)
    return ColumnGeneration(network, graph.n_targets, Fleet.of(graph), prices, parameters, graph.size)


def ascent(generation, limit):
    """Run column generation until it converges or reaches `limit`, in units; return the bounds of its evaluations."""
    bounds = []
    with Watch() as clock:
        generation.run(None, limit, clock, bounds.append)
    return bounds
