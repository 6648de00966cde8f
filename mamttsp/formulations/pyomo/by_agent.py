"""What the baseline and the nonconvex program share: each agent's flow and times, eqs (2)-(6), in Pyomo."""

from functools import partial

import pyomo.environ as pyo

from . import fleet
from .network import network, sum_in


def agent_network(graph, n_agents, name):
    """Return a ConcreteModel with the sets, the variables y[i, j, k] and t[i, k], eqs (2)-(6), and capacities.

    Agents k = 1..m share the one layer of the graph; where it has several, each has the one agent k = 1.
    """
    m = network(graph, name)
    m.V_agt = pyo.RangeSet(1, n_agents if graph.n_layers == 1 else 1)
    m.y = pyo.Var(m.E, m.V_agt, domain=pyo.Binary, doc="y_{e,k}: agent k flies edge e")
    m.t = pyo.Var(m.V, m.V_agt, domain=pyo.NonNegativeReals, doc="t_{i,k}: time of agent k at node i")
    if graph.n_layers == 1:
        add_depot_flow(m, graph)
    else:
        fleet.add_depot_flow_by_agent(m, graph)
    add_flow(m, graph)
    if graph.loaded:
        fleet.add_capacity(m, graph)
    return m


def add_depot_flow(m, graph):
    """Add eqs (2) and (3): each agent's flow from the depot and back."""
    y, E_in, E_out, total = m.y, m.E_in, m.E_out, partial(sum_in, m)

    @m.Constraint(m.V_agt, doc="(2) Each agent leaves the depot at most once.")
    def depot_flow_out(m, k):
        return total(y[e, k] for e in E_out[graph.s]) <= 1

    @m.Constraint(m.V_agt, doc="(3) Each agent returns to the depot at most once.")
    def depot_flow_in(m, k):
        return total(y[e, k] for e in E_in[graph.s_prime]) <= 1


def add_flow(m, graph):
    """Add eqs (4)-(6): each agent's flow through the targets, and the time interval of each node."""
    y, E_in, E_out, total = m.y, m.E_in, m.E_out, partial(sum_in, m)
    t_lo, t_hi = graph.t_lo.tolist(), graph.t_hi.tolist()

    @m.Constraint(m.V_tar, doc="(4) Each target is visited once, by one agent, on one of its segments.")
    def target_flow_in(m, u):
        return total(y[e, k] for k in m.V_agt for i in m.C[u] for e in E_in[i]) == 1

    @m.Constraint(m.V_seg, m.V_agt, doc="(5) An agent that enters a segment leaves it.")
    def flow_conservation(m, i, k):
        return total(y[e, k] for e in E_in[i]) == total(y[e, k] for e in E_out[i])

    @m.Constraint(m.V, m.V_agt, doc="(6) A visit lies in the node's time interval.")
    def node_time_window(m, i, k):
        return pyo.inequality(t_lo[i], m.t[i, k], t_hi[i])
