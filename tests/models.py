"""Which models there are, and tours to carry into them."""

from mamttsp.timing import earliest_times

MODELERS = {"baseline": ("pyomo", "cvxpy"), "nonconvex": ("pyomo",), "micp": ("pyomo", "cvxpy")}
MODELS = [(method, modeler) for method, modelers in MODELERS.items() for modeler in modelers]


def some_routes(graph, m):
    """Return at most m routes through all targets: in the order of deadlines, each where it first fits."""
    segments = sorted(graph.V_seg, key=lambda i: graph.t_hi[i])
    routes, seen = [[] for _ in range(m)], set()
    for i in segments:
        fits = (k for k in range(m) if earliest_times(graph, [*routes[k], i]) is not None)
        if graph.tau[i] not in seen and (k := next(fits, None)) is not None:
            routes[k].append(i)
            seen.add(graph.tau[i])
    assert len(seen) == graph.n_targets
    return [route for route in routes if route]
