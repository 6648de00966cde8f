"""A fractional point of the baseline that pays nothing: the average of all orders, flown by nobody in particular."""

import numpy as np


def average_of_orders(graph):
    """Return (|E|,) the flow on each edge, averaged over all n! orders of one agent and all choices of segments.

    An edge from s to a segment of C_u has 1 / (n |C_u|), as has the one from there to s'; an edge from C_u to C_v has
    1 / (n |C_u| |C_v|): in 1 order out of n, v comes next after u. `graph`: with all its edges.
    """
    cluster_size = np.array([np.count_nonzero(graph.tau == u) if u >= 0 else 1 for u in graph.tau])
    i, j = graph.edges.T
    return 1.0 / (graph.n_targets * cluster_size[i] * cluster_size[j])


def assign_average(formulation):
    """Give every variable of a Pyomo baseline its value at the average of orders, shared equally by the agents.

    Every node is visited in the middle of its time interval, in whatever order these are; every length is 0.
    """
    graph, model, m = formulation.graph, formulation.model, formulation.n_agents
    i, j = graph.edges.T
    y = np.tile(average_of_orders(graph)[:, None] / m, m)
    t = (graph.t_lo + graph.t_hi) / 2.0
    p = graph.p_lo + (t - graph.t_lo)[:, None] * graph.v
    values = {
        "y": y,
        "t": np.tile(t[:, None], m),
        "l": np.zeros_like(y),
        "l_bar": graph.R * (1.0 - y),
        "l_xy": np.tile((p[j] - p[i])[:, None], (1, m, 1)),
    }
    for name, value in values.items():
        variable = getattr(model, name)
        variable.set_values(dict(zip(variable, value.ravel().tolist(), strict=True)), skip_validation=True)
