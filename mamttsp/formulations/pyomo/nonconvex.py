"""The nonconvex MINLP of Section IV-A, eqs (11)-(16), with products of flow and node variables, in Pyomo."""

import pyomo.environ as pyo

from .by_agent import agent_network
from .cones import cone
from .network import motions, speeds


def build(graph, n_agents):
    """Return the nonconvex program as a ConcreteModel for a Graph and m = n_agents agents."""
    m = agent_network(graph, n_agents, "nonconvex")  # sets, y, t, eqs (2)-(6)
    E, V_agt, XY, t, y = m.E, m.V_agt, m.XY, m.t, m.y
    v_max, (v, p_0) = speeds(graph), motions(graph)

    m.p = pyo.Var(m.V, V_agt, XY, doc="p_{i,k}: position of node i at time t_{i,k}")
    m.l = pyo.Var(E, V_agt, domain=pyo.NonNegativeReals, doc="l_{e,k}: length that agent k flies on edge e")
    m.l_xy = pyo.Var(E, V_agt, XY, doc="l_xy_{e,k}: displacement of agent k on edge e")
    m.z_p = pyo.Var(E, V_agt, XY, doc="z_{e,k,p}: the product y_{e,k} p_{i,k}")
    m.z_t = pyo.Var(E, V_agt, doc="z_{e,k,t}: the product y_{e,k} t_{i,k}")
    m.z_p_prime = pyo.Var(E, V_agt, XY, doc="z'_{e,k,p}: the product y_{e,k} p_{j,k}")
    m.z_t_prime = pyo.Var(E, V_agt, doc="z'_{e,k,t}: the product y_{e,k} t_{j,k}")

    @m.Objective(doc="(11) The total length of all tours.")
    def length(m):
        return pyo.quicksum(m.l[e, k] for e in E for k in V_agt)

    @m.Constraint(m.V, V_agt, XY, doc="(12) The position of a node at the time of the visit.")
    def node_position(m, i, k, x):
        return m.p[i, k, x] == p_0[i][x] + t[i, k] * v[i][x]

    @m.Constraint(E, V_agt, doc="(13) No faster than v_max.")
    def speed(m, i, j, k):
        return m.l[i, j, k] <= v_max[i] * (m.z_t_prime[i, j, k] - m.z_t[i, j, k])

    @m.Constraint(E, V_agt, XY, doc="(14) The displacement between the positions at both ends.")
    def displacement(m, i, j, k, x):
        return m.l_xy[i, j, k, x] == m.z_p_prime[i, j, k, x] - m.z_p[i, j, k, x]

    @m.Constraint(E, V_agt, doc="(15) Second-order cone: l is at least the length of the displacement.")
    def norm(m, i, j, k):
        return cone(m.l_xy[i, j, k, 0], m.l_xy[i, j, k, 1], m.l[i, j, k])

    @m.Constraint(E, V_agt, XY, doc="(16) z_p is the product of flow and position at the tail.")
    def product_z_p(m, i, j, k, x):
        return m.z_p[i, j, k, x] == y[i, j, k] * m.p[i, k, x]

    @m.Constraint(E, V_agt, doc="(16) z_t is the product of flow and time at the tail.")
    def product_z_t(m, i, j, k):
        return m.z_t[i, j, k] == y[i, j, k] * t[i, k]

    @m.Constraint(E, V_agt, XY, doc="(16) z'_p is the product of flow and position at the head.")
    def product_z_p_prime(m, i, j, k, x):
        return m.z_p_prime[i, j, k, x] == y[i, j, k] * m.p[j, k, x]

    @m.Constraint(E, V_agt, doc="(16) z'_t is the product of flow and time at the head.")
    def product_z_t_prime(m, i, j, k):
        return m.z_t_prime[i, j, k] == y[i, j, k] * t[j, k]

    return m
