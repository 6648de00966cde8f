"""Routes on a time grid: visits at grid times of their segments, so that a route is a shortest path through layers.
Where a target stands still one point will do, for its flights are as long at any time.

Insertions are priced from the values so far and the values to go at the stops around them. On the grid flights may come
late by a step or so, or it would not hold all routes; whether a route can be flown is told by its exact times.
"""

import math
from collections import namedtuple

import numpy as np

from ..compiled import compiled, inlined
from ..motion import TIME_SLACK
from .reach import fill_reach, make_motion, meet, segments_of

#: Points from which agents of K layers fly, and to which: ahead (K, 2, 3, P + 1), from and to, of x, y and t, and back,
#: the same with time running backward. Points of target u are start[u]:start[u + 1], and behind those of all n targets
#: comes that of the depot, or of the end: target n. near (K, n + 1, n + 1): the shortest flights between targets,
#: whatever their times; segment (P,): of each point its row in the Motion. A flight may be `late` by so many s, and
#: `charge` times the distance that it is short by is added to its length
Network = namedtuple("Network", "ahead back start near late charge segment motion")

#: Grid points: on segments of the graph's first layer, node (P,), from times opens (P,) to closes (P,), the same unless
#: the target stands still; start (n + 1,): where the points of each target begin; step: the longest time between two
Points = namedtuple("Points", "node opens closes start step")

#: Along each route: so_far and to_go (m, n + 1, widest), values at the grid points behind so many stops, and before the
#: last so many of them, in row 0 the 0 of the depot and of the end; the least of each row (m, n + 1); the exact times
#: early and late (m, n + 1, 3), see `reach.fill_reach`; and how many rows were filled so far (1,)
Values = namedtuple("Values", "so_far to_go least_so_far least_to_go early late filled")


def grid_points(graph, targets, points):
    """Return the Points: about so many for each target, both ends of each segment along which it moves among them."""
    rows, start, longest = [], [0], 0.0
    for u in targets:
        cluster = segments_of(graph, u)
        step = (graph.t_hi[cluster] - graph.t_lo[cluster]).sum() / points
        for i in cluster:
            opens, closes = graph.t_lo[i], graph.t_hi[i]
            if opens == closes or not graph.v[i].any():
                rows.append((i, opens, closes))
                continue
            rows += [(i, t, t) for t in np.linspace(opens, closes, 1 + math.ceil((closes - opens) / step))]
            longest = max(longest, step)
        start.append(len(rows))
    node, opens, closes = map(np.array, zip(*rows))
    return Points(node, opens, closes, np.array(start), longest)


def make_networks(graph, targets, points, slack, charges):
    """Return for each of the charges the Network of the targets; points: Points; slack: by how many steps a flight may
    come late."""
    node, opens, closes, start, step = points
    x, y = (graph.p_lo[node] + (opens - graph.t_lo[node])[:, None] * graph.v[node]).T
    leaving = [[np.r_[x, at_x], np.r_[y, at_y], np.r_[opens, 0.0]] for at_x, at_y in graph.p_lo[graph.starts]]
    arriving = [[np.r_[x, at_x], np.r_[y, at_y], np.r_[closes, graph.horizon]] for at_x, at_y in graph.p_lo[graph.ends]]
    ahead = np.stack([leaving, arriving], axis=1)
    back = np.ascontiguousarray(ahead[:, ::-1]) * np.array([1.0, 1.0, -1.0])[:, None]
    start, segment = np.r_[start, len(node) + 1], np.cumsum(np.diff(node, prepend=-1) != 0) - 1
    late, motion = slack * step + TIME_SLACK * graph.horizon, make_motion(graph, targets)
    near = [_nearest(ahead, start, graph.speeds, late, charge) for charge in charges]
    return [Network(ahead, back, start, near, late, charge, segment, motion) for charge, near in zip(charges, near)]


@inlined
def flight(dx, dy, time, speed, late, charge):
    """Return what it costs to fly so far in that time, infinite where it is too late."""
    distance = math.sqrt(dx * dx + dy * dy)
    short = max(distance - speed * time, 0.0)
    return distance + charge * short if short <= speed * late else np.inf


@compiled
def _nearest(ahead, start, speeds, late, charge):
    """Return (K, n + 1, n + 1) the shortest flights from points of one target to points of another."""
    layers, targets = len(speeds), len(start) - 1
    near = np.full((layers, targets, targets), np.inf)
    for k in range(layers):
        x, y, t = ahead[k, 1]
        for u in range(targets):
            for g in range(start[u], start[u + 1]):
                x_g, y_g, t_g = ahead[k, 0, :, g]
                for w in range(targets):
                    for h in range(start[w], start[w + 1] if w != u else start[w]):
                        cost = flight(x[h] - x_g, y[h] - y_g, t[h] - t_g, speeds[k], late, charge)
                        near[k, u, w] = min(near[k, u, w], cost)
    return near


@compiled
def min_plus(values, i, here, there, start, ways, speed, late, charge, out, j):
    """Fill row j of `out`: out[j, h] = least values[i, g] + flight from point g of target `here` to point h of target
    `there`; return the least of it. ways: `ahead` or `back` of a Network, of one layer. Point h is the inner loop,
    without branches: processors do several at once."""
    size, offset = start[there + 1] - start[there], start[there]
    x, y, t = ways[1, 0, offset:], ways[1, 1, offset:], ways[1, 2, offset:]
    for h in range(size):
        out[j, h] = np.inf
    for g in range(start[here + 1] - start[here]):
        value, point = values[i, g], start[here] + g
        if value < np.inf:
            x_g, y_g, t_g = ways[0, 0, point], ways[0, 1, point], ways[0, 2, point]
            for h in range(size):
                cost = value + flight(x[h] - x_g, y[h] - y_g, t[h] - t_g, speed, late, charge)
                out[j, h] = min(out[j, h], cost)
    least = np.inf
    for h in range(size):
        least = min(least, out[j, h])
    return least


@inlined
def stop(route, length, i):
    """Return the target of stop i of a route, that of the depot before and behind all of them."""
    return route[i] if 0 <= i < length else len(route)


@compiled
def evaluate(k, layer, route, length, network, values, ahead, behind):
    """Fill the values along route k, for an agent of a layer, of whose first `ahead` and last `behind` stops they hold
    already; return its cost, infinite if it cannot be flown."""
    flyable = fill_reach(route, length, network.motion, layer, values.early[k], values.late[k], ahead, behind)
    if length == 0:
        return 0.0
    if not flyable:
        return np.inf
    start, so_far, to_go, forth, back = (
        network.start, values.so_far[k], values.to_go[k], network.ahead[layer], network.back[layer]
    )  # fmt: skip
    speed, late, charge = network.motion.speed[layer], network.late, network.charge
    values.filled[0] += 2 * length - ahead - behind
    for i in range(ahead, length):
        values.least_so_far[k, i + 1] = min_plus(
            so_far, i, stop(route, length, i - 1), route[i], start, forth, speed, late, charge, so_far, i + 1
        )
    for rest in range(behind + 1, length + 1):
        i = length - rest
        values.least_to_go[k, rest] = min_plus(
            to_go, rest - 1, stop(route, length, i + 1), route[i], start, back, speed, late, charge, to_go, rest
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
def trace(k, layer, route, length, network, values, segments):
    """Fill in the rows of segments that route k can be flown along, at each stop one of the cheapest flight on from
    there that is met in time for the rest."""
    start, motion, late, charge = network.start, network.motion, network.late, network.charge
    (leaving, arriving), own, speed = network.ahead[layer], motion.ahead[layer], motion.speed[layer]
    here, (px, py, t) = leaving.shape[1] - 1, values.early[k, 0]
    for i in range(length):
        w, best, last, chosen = route[i], np.inf, -1, -1
        met = there = (px, py, np.inf)
        latest = motion.slack - values.late[k, length - i, 2]
        for g in range(start[w], start[w + 1]):
            s = network.segment[g]
            if s != last:
                met, last = meet(px, py, t, own, s, s + 1, speed), s
            dx, dy, time = arriving[:, g] - leaving[:, here]
            cost = flight(dx, dy, time, speed, late, charge) + values.to_go[k, length - i, g - start[w]]
            if met[2] <= latest and (cost < best or chosen < 0):
                best, segments[i], chosen, there = cost, s, g, met
        here, (px, py, t) = chosen, there
