"""Why an instance has no solution, where that can be said in a line: found from flights of one and two visits alone.

It knows no solver. Agents are faster than targets, so an agent that is at a target as early as can be misses nothing
later: `earliest_times` decides exactly whether a given order of visits can be flown.
"""

import dataclasses
import itertools

import networkx as nx
import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import maximum_bipartite_matching

from .graph import build_graph
from .timing import earliest_times
from .validation import counted

#: so many are named, and of the others it is said how many they are
_NAMED = 6
#: said where `why_infeasible` finds nothing
NO_SHORT_REASON = "no short one: each target can be visited, and no count of agents alone rules the instance out"


def why_infeasible(instance):
    """Return in a line why no tours visit all targets, None if there is no reason as short as these.

    Tried in this order: targets that no agent can reach, or be home from by the horizon; targets of which one agent can
    visit no two, more of them than agents; too few targets that can follow another one in a tour, so that more tours
    are needed than there are agents; demands beyond the capacities of all agents. An instance for which None is
    returned may be infeasible all the same.

    >>> from mamttsp import Instance, Target
    >>> from mamttsp.infeasibility import why_infeasible
    >>> east, west = (Target.parked((x, 0), windows=(10, 11)) for x in (30, -30))
    >>> why_infeasible(Instance([east, west], n_agents=1, depot=(0, 0), max_speed=4, horizon=100))
    'no agent can visit two of the targets 0, 1: 2 agents are needed, there is 1'
    """
    graph = build_graph(instance)
    lost = [u for u in range(instance.n_targets) if not _can_be_flown(graph, [u])]
    if lost:
        return _listed([_why_lost(instance, u) for u in lost], "; ")
    follows = _follows(graph)
    for needed, why in (_excluding(follows), _few_followers(follows)):
        if needed > instance.n_agents:
            are = "is" if instance.n_agents == 1 else "are"
            return f"{why}: {counted(needed, 'agent')} are needed, there {are} {instance.n_agents}"
    demand, room = graph.demands.sum(), (graph.counts * graph.room).sum()
    if demand > room:
        return f"the demands of all targets, {demand:g}, exceed the capacities of all agents, {room:g}"
    return None


def _can_be_flown(graph, order):
    """Whether one agent can visit these targets in this order, on any of their segments, and be home in time."""
    return any(earliest_times(graph, route) is not None for route in _routes(graph, order))


def _routes(graph, order):
    """Yield the routes (tuples of segments) through these targets in order, for each type that can bear it."""
    for layer in np.flatnonzero(graph.demands[order].sum() <= graph.room):
        yield from itertools.product(*([i for i in graph.C(u).tolist() if graph.layer[i] == layer] for u in order))


def _why_lost(instance, u):
    """Say of a target that cannot be visited whether it is its demand, the way there or the way home."""
    longest = instance.size / min(entry.max_speed for entry in instance.agents)
    graph = build_graph(dataclasses.replace(instance, horizon=instance.horizon + longest))
    if graph.demands[u] > graph.room.max():
        return f"no agent has the capacity for target {u}, of demand {graph.demands[u]:g}"
    if _can_be_flown(graph, [u]):
        return f"no agent that visits target {u} can be back by the horizon, {instance.horizon:g} s"
    closes = instance.targets[u].windows[-1, 1]
    return f"no agent can be at target {u} in a window, the last of which closes at {closes:g} s"


def _follows(graph):
    """Return (n, n) booleans: whether an agent can visit target u and then v, and be home in time.

    If not, v follows u in no tour: visits before u can only delay it.
    """
    targets = range(graph.n_targets)
    return np.array([[u != v and _can_be_flown(graph, [u, v]) for v in targets] for u in targets])


def _excluding(follows):
    """Return (agents needed, why) from the most targets of which no two can be in one tour."""
    excluded = nx.from_numpy_array(~(follows | follows.T))
    excluded.remove_edges_from(list(nx.selfloop_edges(excluded)))
    targets, needed = nx.max_weight_clique(excluded, weight=None)
    return needed, f"no agent can visit two of the targets {_listed(sorted(targets), ', ')}"


def _few_followers(follows):
    """Return (agents needed, why) from the most targets that can come right after others, each after another one.

    That is a largest matching in the relation. A tour of k visits has k - 1 of them, so that n visits need n less that.
    """
    n = len(follows)
    most = int((maximum_bipartite_matching(csr_array(follows), perm_type="column") >= 0).sum())
    return (
        n - most,
        f"at most {most} of the {n} targets can be visited right after another one, each after a different one",
    )


def _listed(items, separator):
    """Return the first items as text, and how many there are beyond."""
    more = [f"{len(items) - _NAMED} more"] if len(items) > _NAMED else []
    return separator.join([*map(str, items[:_NAMED]), *more])
