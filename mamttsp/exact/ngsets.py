"""ng-sets, and how they grow from the cycles that routes make (dynamic ng-routes, Roberti and Mingozzi 2014)."""

import numpy as np


def nearest(pieces, arcs, n_targets, size):
    """Return N (n, n) bool: for each target the `size` others that are cheapest to fly to or from."""
    least = np.full((n_targets, n_targets), np.inf)
    np.minimum.at(least, (pieces.target[arcs.tail], pieces.target[arcs.head]), arcs.leg[:, 0])
    least = np.minimum(least, least.T)
    order = np.argsort(least, axis=1, kind="stable")[:, :size]
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
