"""From a model's flow y to routes from the depot, and to the cycles that nobody flies.

Where targets meet, the paper's models accept a cycle of zero length and duration that misses the depot; where they
nearly meet, a solver's tolerance accepts it. Only flow that starts at s is a tour.
"""

from typing import NamedTuple

import networkx as nx

from .timing import earliest_times


class FlowError(RuntimeError):
    """A solver's flow that is no set of paths and cycles through every target, or tours that contradict its claims."""


class Routes(NamedTuple):
    """The flow of a model, taken apart.

    paths: tuples of segments (nodes of the graph), each in the order in which one agent flies them from the depot;
    cycles: the same for the flow that misses the depot.
    """

    paths: tuple
    cycles: tuple


def read_flow(graph, flow):
    """Return the Routes in a flow (|E|,) of y summed over the agents; FlowError if it is not what (2)-(5) demand."""
    used = nx.DiGraph(map(tuple, graph.edges[flow > 0.5].tolist()))
    depots = list(zip(graph.starts.tolist(), graph.ends.tolist()))
    used.add_nodes_from(sum(depots, ()))  # with (2) and (3) all agents may stay at home
    _check_degrees(graph, used)
    paths = tuple(_follow(used, first, end) for start, end in depots for first in used.successors(start))
    off = used.subgraph(set(used).difference(*depots, *paths))
    cycles = tuple(_follow(off, min(cycle), min(cycle)) for cycle in nx.strongly_connected_components(off))
    return Routes(paths, cycles)


def targets_of(graph, routes):
    """Return the targets that each route visits, as tuples in order."""
    return tuple(tuple(graph.tau[list(route)].tolist()) for route in routes)


def shortest_unflyable(graph, path):
    """Return the shortest start of a path that no agent can fly and be back in time, None if it can be flown whole."""
    for length in range(1, len(path) + 1):
        if earliest_times(graph, path[:length]) is None:
            return path[:length]
    return None


def _check_degrees(graph, used):
    visits = sorted(graph.tau[[i for i in used if graph.tau[i] >= 0]].tolist())
    through = all(used.in_degree(i) == used.out_degree(i) == 1 for i in used if graph.tau[i] >= 0)
    if visits != list(range(graph.n_targets)) or not through:
        raise FlowError("the solver's flow does not pass once through every target; its tolerance is too loose here")


def _follow(used, first, last):
    """Return the nodes from `first` on, up to the edge into `last`."""
    route = [first]
    while (following := next(used.successors(route[-1]))) != last:
        route.append(following)
    return tuple(route)
