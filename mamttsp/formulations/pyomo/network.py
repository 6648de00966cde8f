"""What the Pyomo models share: the sets of Sections II and III, and each agent's flow and times, eqs (2)-(6)."""

from functools import partial

import pyomo.environ as pyo


def network(graph, name):
    """Return a ConcreteModel with the graph's sets and no variables yet.

    V: nodes, s = 0 first and s' last; V_seg: segments; V_tar: targets from 0; E: edges (i, j) in the order of
    `graph.edges`; XY: the two coordinates. E_in[i], E_out[i]: the edges that enter and leave i; C[u]: the cluster C_u.
    """
    m = pyo.ConcreteModel(name)
    m.V = pyo.RangeSet(graph.s, graph.s_prime)
    m.V_seg = pyo.RangeSet(graph.s + 1, graph.s_prime - 1)
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


def agent_network(graph, n_agents, name):
    """Return a ConcreteModel with the sets, the variables y[i, j, k] and t[i, k], and eqs (2)-(6)."""
    m = network(graph, name)
    m.V_agt = pyo.RangeSet(1, n_agents)
    m.y = pyo.Var(m.E, m.V_agt, domain=pyo.Binary, doc="y_{e,k}: agent k flies edge e")
    m.t = pyo.Var(m.V, m.V_agt, domain=pyo.NonNegativeReals, doc="t_{i,k}: time of agent k at node i")
    add_flow(m, graph)
    return m


def add_flow(m, graph):
    """Add eqs (2)-(6): each agent's flow through the graph, and the time interval of each node."""
    y, E_in, E_out, total = m.y, m.E_in, m.E_out, partial(sum_in, m)
    t_lo, t_hi = graph.t_lo.tolist(), graph.t_hi.tolist()

    @m.Constraint(m.V_agt, doc="(2) Each agent leaves the depot at most once.")
    def depot_flow_out(m, k):
        return total(y[e, k] for e in E_out[graph.s]) <= 1

    @m.Constraint(m.V_agt, doc="(3) Each agent returns to the depot at most once.")
    def depot_flow_in(m, k):
        return total(y[e, k] for e in E_in[graph.s_prime]) <= 1

    @m.Constraint(m.V_tar, doc="(4) Each target is visited once, by one agent, on one of its segments.")
    def target_flow_in(m, u):
        return total(y[e, k] for k in m.V_agt for i in m.C[u] for e in E_in[i]) == 1

    @m.Constraint(m.V_seg, m.V_agt, doc="(5) An agent that enters a segment leaves it.")
    def flow_conservation(m, i, k):
        return total(y[e, k] for e in E_in[i]) == total(y[e, k] for e in E_out[i])

    @m.Constraint(m.V, m.V_agt, doc="(6) A visit lies in the node's time interval.")
    def node_time_window(m, i, k):
        return pyo.inequality(t_lo[i], m.t[i, k], t_hi[i])
