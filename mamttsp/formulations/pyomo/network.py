"""What the Pyomo models share: the sets of Sections II and III, and the numbers of a graph as lists."""

import pyomo.environ as pyo


def network(graph, name):
    """Return a ConcreteModel with the graph's sets and no variables yet.

    V: nodes, in each layer s first and s' last; V_seg: segments; V_tar: targets from 0; E: edges (i, j) in the order of
    `graph.edges`; XY: the two coordinates. E_in[i], E_out[i]: the edges that enter and leave i; C[u]: the cluster C_u.
    """
    m = pyo.ConcreteModel(name)
    m.V = pyo.RangeSet(0, len(graph.tau) - 1)
    m.V_seg = pyo.Set(initialize=graph.V_seg)
    m.V_tar = pyo.RangeSet(0, graph.n_targets - 1)
    m.E = pyo.Set(dimen=2, initialize=[tuple(e) for e in graph.edges.tolist()])
    m.XY = pyo.RangeSet(0, 1)
    m.E_in = {i: [e for e in m.E if e[1] == i] for i in m.V}
    m.E_out = {i: [e for e in m.E if e[0] == i] for i in m.V}
    m.C = {u: graph.C(u).tolist() for u in m.V_tar}
    m.subtour_cuts = pyo.ConstraintList(doc="Cuts against flows that nobody can fly, found while solving.")
    return m


def sum_in(m, terms):
    """Return the sum of the terms, for a row of model m.

    Where pruning has left none, it is a variable fixed at 0: the row stands, and a solver finds it feasible or not.
    """
    terms = list(terms)
    if not terms and m.component("nothing") is None:
        m.nothing = pyo.Var(bounds=(0, 0), initialize=0.0, doc="The sum of no terms.")
    return pyo.quicksum(terms) if terms else m.nothing


def motions(graph):
    """Return (v, p_0) as lists: node i is at p_0[i] + t v[i], with p_0[i] = p_lo_i - t_lo_i v_i."""
    return graph.v.tolist(), (graph.p_lo - graph.t_lo[:, None] * graph.v).tolist()


def speeds(graph):
    """Return v_max as a list: that of the agents in the layer of each node."""
    return graph.speeds[graph.layer].tolist()
