"""Routes on a time grid: visits at grid times of their segments, so that a route is a shortest path through layers.

Insertions are priced from the values so far and the values to go at the stops around them.
"""

import math
from collections import namedtuple

import numpy as np

from ..compiled import compiled, inlined
from ..motion import TIME_SLACK

#: Flights on the grid, infinite where too late: between (P + 1, P + 1), and its transpose back. The points of target u
#: are start[u]:start[u + 1], and behind those of all n targets comes one for the depot, as a head the end: target n;
#: near (n + 1, n + 1): the shortest flights between targets, whatever their times
Network = namedtuple("Network", "between back start near")

#: Along a route: so_far and to_go (n + 1, widest), values at the grid points behind so many stops, and before the last
#: so many of them, in row 0 the 0 of the depot and of the end; and the least of each row (n + 1,)
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
    start = np.r_[start, len(time) + 1]
    owner = np.repeat(np.arange(len(start) - 1), np.diff(start))
    leaving, arriving, slack = np.r_[time, 0.0], np.r_[time, graph.horizon], slack + TIME_SLACK * graph.horizon
    between = []
    for depot, end, speed in zip(graph.p_lo[graph.starts], graph.p_lo[graph.ends], graph.speeds):
        (x, y), (x_to, y_to) = np.vstack([p, depot]).T, np.vstack([p, end]).T
        flights = np.hypot(x_to - x[:, None], y_to - y[:, None])
        flights[(owner == owner[:, None]) | (flights > speed * (arriving - leaving[:, None] + slack))] = np.inf
        between.append(flights)
    between = np.array(between)
    near = np.minimum.reduceat(np.minimum.reduceat(between, start[:-1], axis=1), start[:-1], axis=2)
    return Network(between, between.transpose(0, 2, 1).copy(), start, near)


@compiled
def of_layer(networks, k):
    """Return the Network of layer k."""
    return Network(networks.between[k], networks.back[k], networks.start, networks.near[k])


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


@inlined
def _stop(route, length, i):
    """Return the target of stop i of a route, that of the depot before and behind all of them."""
    return route[i] if 0 <= i < length else len(route)


@compiled
def evaluate(route, length, network, values):
    """Fill the values along a route; return its cost."""
    if length == 0:
        return 0.0
    start, so_far, to_go = network.start, values.so_far, values.to_go
    for i in range(length):
        values.least_so_far[i + 1] = _min_plus(
            so_far[i], _stop(route, length, i - 1), route[i], start, network.between, so_far[i + 1]
        )
    for i in range(length - 1, -1, -1):
        rest = length - i
        values.least_to_go[rest] = _min_plus(
            to_go[rest - 1], _stop(route, length, i + 1), route[i], start, network.back, to_go[rest]
        )
    return _least_sum(so_far[1], to_go[length], start[route[0] + 1] - start[route[0]])


@compiled
def insertion(w, route, length, i, network, values, arrive, leave, cutoff):
    """Return the route's cost with w inserted before its stop i, or infinity if that is not below the cutoff."""
    start, rest = network.start, length - i
    before, behind = _stop(route, length, i - 1), _stop(route, length, i)
    to_go = network.near[w, behind] + values.least_to_go[rest]
    if values.least_so_far[i] + network.near[before, w] + to_go >= cutoff:
        return np.inf
    if _min_plus(values.so_far[i], before, w, start, network.between, arrive) + to_go >= cutoff:
        return np.inf
    _min_plus(values.to_go[rest], behind, w, start, network.back, leave)
    return _least_sum(arrive, leave, start[w + 1] - start[w])


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
    start, here = network.start, len(network.between) - 1
    for i in range(length):
        w = route[i]
        best = np.inf
        for g in range(start[w], start[w + 1]):
            cost = network.between[here, g] + values.to_go[length - i, g - start[w]]
            if cost < best:
                best, points[i] = cost, g
        here = points[i]
