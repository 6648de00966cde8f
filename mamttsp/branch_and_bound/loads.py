"""How many agents of each layer there are and what they can carry: what a set of routes must keep to."""

import numpy as np


def load_limits(graph):
    """Return (2, |E|) the least and the most load of each edge, if it is flown; more least than most: it cannot be.

    The load of an edge has the demands of all targets before its end. It is 0 on the way from a depot.
    """
    tail, head = graph.edges.T
    demand = np.where(graph.tau >= 0, graph.demands[graph.tau], 0.0)
    room = graph.room[graph.layer[tail]] - demand[head]
    return np.stack([demand[tail], np.where(np.isin(tail, graph.starts), np.minimum(room, 0.0), room)])


def fits(graph, route):
    """Tell whether an agent of the route's layer can carry the demands of its targets."""
    return graph.demands[graph.tau[list(route)]].sum() <= graph.room[graph.layer[route[0]]]


def enough_agents(graph, counts, routes):
    """Tell whether each layer has an agent for each of its routes; counts: (K,)."""
    used = np.bincount(graph.layer[[route[0] for route in routes]], minlength=len(counts))
    return bool((used <= counts).all())
