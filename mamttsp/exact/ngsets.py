"""ng-sets, and how they grow from the cycles that routes make (dynamic ng-routes, Roberti and Mingozzi 2014)."""

import numpy as np


def nearest(pieces, arcs, n_targets, size):
    """Return N (n, n) bool: for each target `size` others, first those to and from which an agent can fly within the
    same pieces, so that it could go round and round, then those cheapest to fly to or from."""
    tail, head = arcs.tail.astype(np.int64), arcs.head.astype(np.int64)
    mutual = np.isin(tail * len(pieces.a) + head, head * len(pieces.a) + tail)
    least, round_trip = np.full((2, n_targets, n_targets), np.inf)
    np.minimum.at(least, (pieces.target[arcs.tail], pieces.target[arcs.head]), arcs.leg[:, 0])
    round_trip[pieces.target[arcs.tail[mutual]], pieces.target[arcs.head[mutual]]] = 0.0
    least = np.minimum(least, least.T)
    order = np.lexsort((least, round_trip), axis=1)[:, :size]
    N = np.zeros((n_targets, n_targets), dtype=bool)
    np.put_along_axis(N, order, np.isfinite(np.take_along_axis(least, order, axis=1)), axis=1)
    return N


def forbidden(route, N):
    """Tell whether a route, a sequence of targets, repeats one that it remembers."""
    memory = set()
    for u in route:
        if u in memory:
            return True
        memory = {w for w in memory if N[u, w]} | {u}
    return False


def grown(routes, N, longest):
    """Return N with what it takes to forbid each cycle of up to `longest` visits in the routes: the repeated target in
    the ng-set of all between."""
    N = N.copy()
    for route in routes:
        last = {}
        for k, u in enumerate(route):
            if u in last and k - last[u] <= longest:
                N[route[last[u] + 1 : k], u] = True
            last[u] = k
    return N
