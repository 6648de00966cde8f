"""The baseline MICP of Section III, eqs (1)-(10), with big-M constraints, in Pyomo."""

import pyomo.environ as pyo

from .by_agent import agent_network
from .cones import cone
from .network import motions, speeds


def build(graph, n_agents):
    """Return the baseline as a ConcreteModel for a Graph and m = n_agents agents."""
    m = agent_network(graph, n_agents, "baseline")  # sets, y, t, eqs (2)-(6)
    E, V_agt, t, y = m.E, m.V_agt, m.t, m.y
    v_max, T, R = speeds(graph), graph.horizon, graph.R
    v, p_0 = motions(graph)

    m.l = pyo.Var(E, V_agt, domain=pyo.NonNegativeReals, doc="l_{e,k}: length that agent k flies on edge e")
    m.l_bar = pyo.Var(E, V_agt, domain=pyo.NonNegativeReals, doc="l_bar_{e,k}: l_{e,k} where e is flown, else R more")
    m.l_xy = pyo.Var(E, V_agt, m.XY, doc="l_xy_{e,k}: displacement p_{j,k} - p_{i,k}")

    @m.Objective(doc="(1) The total length of all tours.")
    def length(m):
        return pyo.quicksum(m.l[e, k] for e in E for k in V_agt)

    @m.Constraint(E, V_agt, doc="(7) No faster than v_max on an edge that is flown.")
    def speed(m, i, j, k):
        return m.l[i, j, k] <= v_max[i] * (t[j, k] - t[i, k] + T * (1 - y[i, j, k]))

    @m.Constraint(E, V_agt, m.XY, doc="(8) The displacement between the positions at both ends.")
    def displacement(m, i, j, k, x):
        p_i = p_0[i][x] + t[i, k] * v[i][x]
        p_j = p_0[j][x] + t[j, k] * v[j][x]
        return m.l_xy[i, j, k, x] == p_j - p_i

    @m.Constraint(E, V_agt, doc="(9) Big-M: only an edge that is flown has to pay for its length.")
    def big_m(m, i, j, k):
        return m.l_bar[i, j, k] == m.l[i, j, k] + R * (1 - y[i, j, k])

    @m.Constraint(E, V_agt, doc="(10) Second-order cone: l_bar is at least the length of the displacement.")
    def norm(m, i, j, k):
        return cone(m.l_xy[i, j, k, 0], m.l_xy[i, j, k, 1], m.l_bar[i, j, k])

    return m
