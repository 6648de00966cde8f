"""Routes on a time grid: visits at grid times of their segments, so that a route is a shortest path through layers.

Insertions are priced from the values so far and the values to go at the stops around them.
"""

import math
from collections import namedtuple

import numpy as np

from ..compiled import compiled
from ..motion import TIME_SLACK

#: Flights on the grid, infinite where too late: `between` (P, P), its transpose `back`, from the depot `first` (P,), to
#: the end `last` (P,); the points of target u are start[u]:start[u + 1]; near (n, n), near_first (n,),
#: near_last (n,): the shortest flights between targets, depot and end, whatever their times
Network = namedtuple("Network", "between back first last start near near_first near_last")

#: Of each stop of a route: values so_far and to_go (n, widest) at its grid points, and the least of them (n,)
Values = namedtuple("Values", "so_far to_go least_so_far least_to_go")


def grid_points(graph, targets, points):
    """Return (node, time, start, step): about so many points for each target, both ends of each of its segments among
    them.

    Nodes are those of the graph's first layer. start: (n + 1,) where the points of each target begin; step: the longest
    time between two points.
    """
    nodes, times, start, longest = [], [], [0], 0.0
    for u in targets:
        cluster = graph.C(u)
        cluster = cluster[graph.layer[cluster] == 0]
        step = (graph.t_hi[cluster] - graph.t_lo[cluster]).sum() / points
        for i in cluster:
            duration = graph.t_hi[i] - graph.t_lo[i]
            grid = np.linspace(graph.t_lo[i], graph.t_hi[i], 1 + math.ceil(duration / step) if duration > 0 else 1)
            nodes.append(np.full(len(grid), i))
            times.append(grid)
        start.append(start[-1] + sum(len(grid) for grid in times[-len(cluster) :]))
        longest = max(longest, step)
    return np.concatenate(nodes), np.concatenate(times), np.array(start), longest


def make_networks(graph, node, time, start, slack):
    """Return the Networks of grid points, see `grid_points`, one for each layer of the graph, in a Network whose arrays
    but `start` have one dimension more; slack: by how many s a flight may come late."""
    p = graph.p_lo[node] + (time - graph.t_lo[node])[:, None] * graph.v[node]
    owner = np.repeat(np.arange(len(start) - 1), np.diff(start))
    depots, ends = graph.p_lo[graph.starts], graph.p_lo[graph.ends]
    each = [_distances(p, time, owner, *of_layer, graph.horizon, slack) for of_layer in zip(depots, ends, graph.speeds)]
    near = [_shortest(*flights, start) for flights in each]
    between, first, last = map(np.array, zip(*each))
    return Network(between, between.transpose(0, 2, 1).copy(), first, last, start, *map(np.array, zip(*near)))


@compiled
def of_layer(networks, k):
    """Return the Network of layer k."""
    return Network(
        networks.between[k], networks.back[k], networks.first[k], networks.last[k], networks.start, networks.near[k],
        networks.near_first[k], networks.near_last[k],
    )  # fmt: skip


def _distances(p, time, target, depot, end, speed, horizon, slack):
    """Return (between (P, P), first (P,), last (P,)): distances, infinite where a flight would be more than `slack`
    s late."""
    slack += TIME_SLACK * horizon
    x, y = p.T
    between = np.hypot(x - x[:, None], y - y[:, None])
    between[(target == target[:, None]) | (between > speed * (time - time[:, None] + slack))] = np.inf
    first, last = np.hypot(x - depot[0], y - depot[1]), np.hypot(x - end[0], y - end[1])
    first[first > speed * (time + slack)] = np.inf
    last[last > speed * (horizon - time + slack)] = np.inf
    return between, first, last


def _shortest(between, first, last, start):
    """Return (near (n, n), near_first (n,), near_last (n,)), see Network."""
    begin = start[:-1]
    near = np.minimum.reduceat(np.minimum.reduceat(between, begin, axis=0), begin, axis=1)
    return near, np.minimum.reduceat(first, begin), np.minimum.reduceat(last, begin)


@compiled
def _min_plus(values, here, there, start, flights, out):
    """out[h] = least values[g] + flights from point g of target `here` to point h of target `there`; return the least
    of out. Point h is the inner loop: along the rows of `flights`, without branches, processors do several at once."""
    size, offset = start[there + 1] - start[there], start[there]
    out = out[:size]
    out[:] = np.inf
    for g in range(start[here + 1] - start[here]):
        if values[g] < np.inf:
            row = flights[start[here] + g, offset : offset + size]
            for h in range(size):
                out[h] = min(out[h], values[g] + row[h])
    return out.min()


@compiled
def _arrive(w, route, i, network, values, out):
    """Fill out with the values so far of target w behind the first i stops of a route; return the least of them."""
    if i > 0:
        return _min_plus(values.so_far[i - 1], route[i - 1], w, network.start, network.between, out)
    for g in range(network.start[w], network.start[w + 1]):
        out[g - network.start[w]] = network.first[g]
    return network.near_first[w]


@compiled
def _leave(w, route, length, i, network, values, out):
    """Fill out with the values to go of target w before stop i of a route; return the least of them."""
    if i < length:
        return _min_plus(values.to_go[i], route[i], w, network.start, network.back, out)
    for g in range(network.start[w], network.start[w + 1]):
        out[g - network.start[w]] = network.last[g]
    return network.near_last[w]


@compiled
def evaluate(route, length, network, values):
    """Fill the values at each stop of a route; return its cost."""
    if length == 0:
        return 0.0
    for i in range(length):
        values.least_so_far[i] = _arrive(route[i], route, i, network, values, values.so_far[i])
    for i in range(length - 1, -1, -1):
        values.least_to_go[i] = _leave(route[i], route, length, i + 1, network, values, values.to_go[i])
    size = network.start[route[0] + 1] - network.start[route[0]]
    return _least_sum(values.so_far[0], values.to_go[0], size)


@compiled
def insertion(w, route, length, i, network, values, arrive, leave, cutoff):
    """Return the route's cost with w inserted before its stop i, or infinity if that is not below the cutoff."""
    before = network.near_first[w] if i == 0 else values.least_so_far[i - 1] + network.near[route[i - 1], w]
    after = network.near_last[w] if i == length else network.near[w, route[i]] + values.least_to_go[i]
    if before + after >= cutoff or _arrive(w, route, i, network, values, arrive) + after >= cutoff:
        return np.inf
    _leave(w, route, length, i, network, values, leave)
    size = network.start[w + 1] - network.start[w]
    return _least_sum(arrive, leave, size)


@compiled
def _least_sum(so_far, to_go, size):
    """Return the least sum of the two at one of the first `size` points."""
    least = np.inf
    for g in range(size):
        least = min(least, so_far[g] + to_go[g])
    return least


@compiled
def trace(route, length, network, values, points):
    """Fill the grid points of a cheapest flight along a route that is evaluated."""
    start = network.start
    for i in range(length):
        w = route[i]
        best = np.inf
        for g in range(start[w], start[w + 1]):
            here = network.first[g] if i == 0 else network.between[points[i - 1], g]
            if here + values.to_go[i, g - start[w]] < best:
                best, points[i] = here + values.to_go[i, g - start[w]], g
