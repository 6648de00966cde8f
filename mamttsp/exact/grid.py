"""Routes on a time grid: visits at grid times of their segments, so that a route is a shortest path through layers.

Insertions are priced from the values so far and the values to go at the stops around them. On the grid flights may come
late by a step or so, or it would not hold all routes; whether a route can be flown is told by its exact times.
"""

import math
from collections import namedtuple

import numpy as np

from ..compiled import compiled, inlined
from ..motion import TIME_SLACK
from .reach import Motion, fill_reach, make_motions, meet, segments_of

#: Flights on the grid, infinite where too late: between (P + 1, P + 1), and its transpose back. The points of target u
#: are start[u]:start[u + 1], and behind those of all n targets comes one for the depot, as a head the end: target n;
#: near (n + 1, n + 1): the shortest flights between targets, whatever their times; segment (P,): of each point its row
#: in the Motion
Network = namedtuple("Network", "between back start near segment motion")

#: Along a route: so_far and to_go (n + 1, widest), values at the grid points behind so many stops, and before the last
#: so many of them, in row 0 the 0 of the depot and of the end; the least of each row (n + 1,); and the exact times
Values = namedtuple("Values", "so_far to_go least_so_far least_to_go early late")


def grid_points(graph, targets, points):
    """Return (node, time, start, step): about so many points for each target, both ends of each of its segments among
    them.

    Nodes are those of the graph's first layer. start: (n + 1,) where the points of each target begin; step: the longest
    time between two points.
    """
    nodes, times, start, longest = [], [], [0], 0.0
    for u in targets:
        cluster = segments_of(graph, u)
        step = (graph.t_hi[cluster] - graph.t_lo[cluster]).sum() / points
        for i in cluster:
            duration = graph.t_hi[i] - graph.t_lo[i]
            grid = np.linspace(graph.t_lo[i], graph.t_hi[i], 1 + math.ceil(duration / step) if duration > 0 else 1)
            nodes.append(np.full(len(grid), i))
            times.append(grid)
        start.append(start[-1] + sum(len(grid) for grid in times[-len(cluster) :]))
        longest = max(longest, step)
    return np.concatenate(nodes), np.concatenate(times), np.array(start), longest


def make_networks(graph, targets, points, slack, charges):
    """Return for each of the charges the Networks of the targets, one for each layer of the graph, in a Network whose
    arrays but `start` and `segment` have one dimension more; points: see `grid_points`; slack: by how many steps a
    flight may come late; charges: of the distance that it is short by, how much is added to its length."""
    node, time, start, step = points
    p = graph.p_lo[node] + (time - graph.t_lo[node])[:, None] * graph.v[node]
    start = np.r_[start, len(time) + 1]
    owner = np.repeat(np.arange(len(start) - 1), np.diff(start))
    leaving, arriving = np.r_[time, 0.0], np.r_[time, graph.horizon]
    late = slack * step + TIME_SLACK * graph.horizon
    between, missing = [], []
    for depot, end, speed in zip(graph.p_lo[graph.starts], graph.p_lo[graph.ends], graph.speeds):
        (x, y), (x_to, y_to) = np.vstack([p, depot]).T, np.vstack([p, end]).T
        flights = np.hypot(x_to - x[:, None], y_to - y[:, None])
        short = np.maximum(flights - speed * (arriving - leaving[:, None]), 0.0)
        flights[(owner == owner[:, None]) | (short > speed * late)] = np.inf
        between.append(flights)
        missing.append(short)
    segment = np.cumsum(np.diff(node, prepend=-1) != 0) - 1
    shared, motions = (np.array(between), np.array(missing)), make_motions(graph, targets)
    return [_charged(*shared, charge, start, segment, motions) for charge in charges]


def _charged(between, missing, charge, start, segment, motions):
    between = between + charge * missing
    near = np.minimum.reduceat(np.minimum.reduceat(between, start[:-1], axis=1), start[:-1], axis=2)
    return Network(between, between.transpose(0, 2, 1).copy(), start, near, segment, motions)


@compiled
def of_layer(networks, k):
    """Return the Network of layer k."""
    own = networks.motion
    motion = Motion(own.first, own.ahead[k], own.back[k], own.speed[k], own.slack)
    return Network(
        networks.between[k], networks.back[k], networks.start, networks.near[k], networks.segment, motion
    )  # fmt: skip


@compiled
def min_plus(values, i, here, there, start, flights, out, j):
    """Fill row j of `out`: out[j, h] = least values[i, g] + flights from point g of target `here` to point h of target
    `there`; return the least of it. Point h is the inner loop: along the rows of `flights`, without branches,
    processors do several at once."""
    size, offset = start[there + 1] - start[there], start[there]
    for h in range(size):
        out[j, h] = np.inf
    for g in range(start[here + 1] - start[here]):
        value, row = values[i, g], start[here] + g
        if value < np.inf:
            for h in range(size):
                out[j, h] = min(out[j, h], value + flights[row, offset + h])
    least = np.inf
    for h in range(size):
        least = min(least, out[j, h])
    return least


@inlined
def stop(route, length, i):
    """Return the target of stop i of a route, that of the depot before and behind all of them."""
    return route[i] if 0 <= i < length else len(route)


@compiled
def evaluate(route, length, network, values, ahead, behind):
    """Fill the values along a route, of whose first `ahead` and last `behind` stops they hold already; return its cost,
    infinite if it cannot be flown."""
    flyable = fill_reach(route, length, network.motion, values.early, values.late, ahead, behind)
    if length == 0:
        return 0.0
    if not flyable:
        return np.inf
    start, between, back, so_far, to_go = network.start, network.between, network.back, values.so_far, values.to_go
    for i in range(ahead, length):
        values.least_so_far[i + 1] = min_plus(
            so_far, i, stop(route, length, i - 1), route[i], start, between, so_far, i + 1
        )
    for rest in range(behind + 1, length + 1):
        i = length - rest
        values.least_to_go[rest] = min_plus(
            to_go, rest - 1, stop(route, length, i + 1), route[i], start, back, to_go, rest
        )
    return least_sum(so_far, 1, to_go, length, start[route[0] + 1] - start[route[0]])


@inlined
def least_sum(so_far, i, to_go, rest, size):
    """Return the least sum of row i of the one and row `rest` of the other at one of the first `size` points."""
    least = np.inf
    for g in range(size):
        least = min(least, so_far[i, g] + to_go[rest, g])
    return least


@compiled
def trace(route, length, network, values, segments):
    """Fill in the rows of segments that a route can be flown along, at each stop one of the cheapest flight on from
    there that is met in time for the rest."""
    start, motion, here = network.start, network.motion, len(network.between) - 1
    px, py, t = values.early[0]
    for i in range(length):
        w, best, last, chosen = route[i], np.inf, -1, -1
        met = there = (px, py, np.inf)
        latest = motion.slack - values.late[length - i, 2]
        for g in range(start[w], start[w + 1]):
            s = network.segment[g]
            if s != last:
                met, last = meet(px, py, t, motion.ahead, s, s + 1, motion.speed), s
            cost = network.between[here, g] + values.to_go[length - i, g - start[w]]
            if met[2] <= latest and (cost < best or chosen < 0):
                best, segments[i], chosen, there = cost, s, g, met
        here, (px, py, t) = chosen, there
