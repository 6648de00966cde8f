"""From a solved model back to tours: the procedure of Section IV-B, by graph search, and the cycles it would miss."""

from typing import NamedTuple

import numpy as np
import pyomo.environ as pyo

from ..subtours import read_flow
from ..times import to_tour
from ..tours import Visit


class Recovered(NamedTuple):
    """What the values of a model say: tours from the depot, and cycles (tuples of Visits) that miss it."""

    tours: tuple
    cycles: tuple


def recover(formulation):
    """Return the Recovered tours and cycles of a formulation whose variables have values; the inverse of `assign`.

    Visit times are the model's own, t_{i,k} or z'_{e,t}, so they are as accurate as its solver; a tour is back at the
    depot as soon as it can be. FlowError: y is no flow through every target.
    """
    graph = formulation.graph
    y = _values(formulation.model.y, len(graph.edges))
    paths, cycles = read_flow(graph, y.sum(axis=1))
    times = _visit_times(formulation, y)
    tours = tuple(to_tour(graph, path, times[list(path)]) for path in paths)
    return Recovered(tours, tuple(_visits(graph, cycle, times) for cycle in cycles))


def _visits(graph, nodes, times):
    return tuple(
        Visit(int(graph.tau[i]), float(times[i]), tuple(map(float, graph.position(i, times[i])))) for i in nodes
    )


def _visit_times(formulation, y):
    """Return (|V|,) the time of each node that is visited, within its interval; nothing of use at other nodes."""
    graph, model = formulation.graph, formulation.model
    heads, flown = graph.edges[:, 1], y > 0.5
    times = np.zeros(len(graph.tau))
    if formulation.method == "micp":
        used = flown[:, 0]
        times[heads[used]] = _values(model.z_t_prime, len(heads))[used, 0]
    else:
        edge, agent = np.nonzero(flown)
        times[heads[edge]] = _values(model.t, len(times))[heads[edge], agent]
    return np.clip(times, graph.t_lo, graph.t_hi)


def _values(variable, rows):
    """Return the values of a Pyomo or cvxpy variable as an array with this many rows."""
    if isinstance(variable, pyo.Var):
        values = [component.value for component in variable.values()]
    else:
        values = variable.value
    return np.array(values, dtype=float).reshape(rows, -1)
