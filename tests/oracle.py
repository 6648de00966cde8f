"""The optimum of a small instance by enumeration: every order, every choice of segments, every division among agents.

It shares with the package the graph's nodes and the best times of one fixed order (tests/test_tours.py holds those
against another solver), and nothing with any formulation, edge set or branch and bound.
"""

import dataclasses
import functools
import itertools
import math

import numpy as np

from mamttsp import Instance, build_graph
from mamttsp.timing import best_times, earliest_times


def optimum(instance):
    """Return the least total length of tours that visit every target once, of each type of agents no more tours than
    agents, none with more demand than its agent's capacity; inf if there is none."""
    targets = range(instance.n_targets)
    best = {frozenset(): 0.0}  # with no agent so far, only the empty set can be visited
    for entry in instance.agents:
        alone = dataclasses.replace(entry, count=1, capacity=None)
        one = Instance(
            [_without_demand(target) for target in instance.targets], agents=[alone], horizon=instance.horizon
        )
        shortest = {frozenset(): 0.0} | _carried(instance, entry, shortest_tours(one))
        for _ in range(entry.count):
            best = {
                S: min(shortest.get(own, math.inf) + best.get(S - own, math.inf) for own in subsets(S))
                for S in subsets(targets)
            }
    return best[frozenset(targets)]


def _without_demand(target):
    return dataclasses.replace(target, demand=0.0)


def _carried(instance, entry, tours):
    """Return those of the tours {set of targets: length} whose demands are within the capacity of an agent."""
    limit = math.inf if entry.capacity is None else entry.capacity
    return {
        S: length for S, length in tours.items() if math.fsum(instance.targets[u].demand for u in S) <= limit + 1e-9
    }


def subsets(items):
    """Return all subsets of the items, the empty one first."""
    return [
        frozenset(chosen) for size in range(len(items) + 1) for chosen in itertools.combinations(sorted(items), size)
    ]


@functools.cache
def shortest_tours(instance):
    """Return {set of targets: length of the shortest tour of one agent through them}, for the sets that one can fly."""
    graph = build_graph(instance)
    routes = {}
    for route, bound in _flyable_routes(graph, ()):
        routes.setdefault(frozenset(graph.tau[list(route)].tolist()), []).append((bound, route))
    return {targets: _shortest(graph, choices) for targets, choices in routes.items()}


def _flyable_routes(graph, route):
    """Yield (route, lower bound on its length) for every route from here on that can be flown in time.

    What cannot be flown home in time cannot be flown with more visits either, so such a route is not continued.
    """
    visited = set(graph.tau[list(route)])
    for i in graph.V_seg:
        longer = (*route, i)
        if graph.tau[i] in visited or (earliest := earliest_times(graph, longer)) is None:
            continue
        yield longer, _lower_bound(graph, longer, earliest)
        yield from _flyable_routes(graph, longer)


def _lower_bound(graph, route, earliest):
    """Every visit lies on its segment after the earliest time, so in the disc that has this stretch as its diameter."""
    ends = np.array([graph.p_hi[i] for i in route])
    starts = np.array([graph.position(i, t) for i, t in zip(route, earliest)])
    centres = np.vstack([graph.p_lo[graph.s], (starts + ends) / 2, graph.p_lo[graph.s_prime]])
    radii = np.concatenate([[0.0], np.hypot(*(ends - starts).T) / 2, [0.0]])
    apart = np.hypot(*np.diff(centres, axis=0).T) - radii[:-1] - radii[1:]
    return np.maximum(apart, 0.0).sum()


def _shortest(graph, choices):
    """Return the least length among the routes, in the order of their bounds, until no bound is below the best."""
    best = math.inf
    for bound, route in sorted(choices):
        if bound >= best:
            break
        best = min(best, best_times(graph, list(route))[0])
    return best
