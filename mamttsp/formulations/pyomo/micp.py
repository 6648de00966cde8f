"""The new MICP of Section IV-B, eqs (17)-(29), with perspective constraints and one flow for all agents, in Pyomo."""

from functools import partial

import pyomo.environ as pyo

from . import fleet
from .cones import cone
from .network import motions, network, speeds, sum_in


def build(graph, n_agents):
    """Return the new MICP as a ConcreteModel for a Graph and m = n_agents agents.

    Several types of agents, a layer of the graph each, have the numbers of the graph instead.
    """
    m = network(graph, "micp")
    E, XY = m.E, m.XY
    if graph.n_layers == 1:
        m.alpha = pyo.Var(domain=pyo.Integers, doc="alpha: number of agents that fly")
    m.y = pyo.Var(E, domain=pyo.Binary, doc="y_e: an agent flies edge e")
    m.l = pyo.Var(E, domain=pyo.NonNegativeReals, doc="l_e: length flown on edge e")
    m.l_xy = pyo.Var(E, XY, doc="l_xy_e: displacement on edge e")
    m.z_p = pyo.Var(E, XY, doc="z_{e,p}: position at the tail of e, 0 if e is not flown")
    m.z_t = pyo.Var(E, doc="z_{e,t}: time at the tail of e, 0 if e is not flown")
    m.z_p_prime = pyo.Var(E, XY, doc="z'_{e,p}: position at the head of e, 0 if e is not flown")
    m.z_t_prime = pyo.Var(E, doc="z'_{e,t}: time at the head of e, 0 if e is not flown")

    @m.Objective(doc="(17) The total length of all tours.")
    def length(m):
        return pyo.quicksum(m.l[e] for e in E)

    if graph.n_layers == 1:
        _add_depot_flow(m, graph, n_agents)
    else:
        fleet.add_depot_flow_by_type(m, graph)
    _add_flow(m)
    if graph.loaded:
        fleet.add_loads(m, graph)
    _add_perspectives(m, graph)
    _add_lengths(m, graph)
    return m


def _add_depot_flow(m, graph, n_agents):
    y, alpha, E_in, E_out, total = m.y, m.alpha, m.E_in, m.E_out, partial(sum_in, m)

    @m.Constraint(doc="(18) alpha agents leave the depot.")
    def flow_from_depot(m):
        return total(y[e] for e in E_out[graph.s]) == alpha

    @m.Constraint(doc="(19) alpha agents return to the depot.")
    def flow_to_depot(m):
        return total(y[e] for e in E_in[graph.s_prime]) == alpha

    @m.Constraint(doc="(20) At least one agent flies, at most m.")
    def number_of_agents(m):
        return pyo.inequality(1, alpha, n_agents)


def _add_flow(m):
    y, E_in, E_out, total = m.y, m.E_in, m.E_out, partial(sum_in, m)

    @m.Constraint(m.V_tar, doc="(21) Each target is visited once, on one of its segments.")
    def one_segment_per_cluster(m, u):
        return total(y[e] for i in m.C[u] for e in E_in[i]) == 1

    @m.Constraint(m.V_seg, doc="(22) An agent that enters a segment leaves it...")
    def flow_conservation(m, i):
        return total(y[e] for e in E_in[i]) == total(y[e] for e in E_out[i])

    @m.Constraint(m.V_seg, doc="(22) ... at the time at which it came.")
    def time_conservation(m, i):
        return total(m.z_t_prime[e] for e in E_in[i]) == total(m.z_t[e] for e in E_out[i])


def _add_perspectives(m, graph):
    """Add (23)-(26): (z_p, z_t) in y_e X_i and (z'_p, z'_t) in y_e X_j, X_i being the segment in space and time."""
    y, bounds = m.y, ("lower", "upper")
    t = {"lower": graph.t_lo.tolist(), "upper": graph.t_hi.tolist()}
    v, p_0 = motions(graph)

    @m.Constraint(m.E, bounds, doc="(23) If e is flown, its tail is left within the tail's time interval.")
    def time_at_tail(m, i, j, bound):
        edge_time, limit = m.z_t[i, j], t[bound][i] * y[i, j]
        return edge_time >= limit if bound == "lower" else edge_time <= limit

    @m.Constraint(m.E, bounds, doc="(24) If e is flown, its head is reached within the head's time interval.")
    def time_at_head(m, i, j, bound):
        edge_time, limit = m.z_t_prime[i, j], t[bound][j] * y[i, j]
        return edge_time >= limit if bound == "lower" else edge_time <= limit

    @m.Constraint(m.E, m.XY, doc="(25) If e is flown, z_p is the position of its tail at time z_t.")
    def position_at_tail(m, i, j, x):
        return m.z_p[i, j, x] == v[i][x] * m.z_t[i, j] + p_0[i][x] * y[i, j]

    @m.Constraint(m.E, m.XY, doc="(26) If e is flown, z'_p is the position of its head at time z'_t.")
    def position_at_head(m, i, j, x):
        return m.z_p_prime[i, j, x] == v[j][x] * m.z_t_prime[i, j] + p_0[j][x] * y[i, j]


def _add_lengths(m, graph):
    v_max = speeds(graph)

    @m.Constraint(m.E, doc="(27) No faster than v_max.")
    def speed(m, i, j):
        return m.l[i, j] <= v_max[i] * (m.z_t_prime[i, j] - m.z_t[i, j])

    @m.Constraint(m.E, m.XY, doc="(28) The displacement between the positions at both ends.")
    def displacement(m, i, j, x):
        return m.l_xy[i, j, x] == m.z_p_prime[i, j, x] - m.z_p[i, j, x]

    @m.Constraint(m.E, doc="(29) Second-order cone: l is at least the length of the displacement.")
    def norm(m, i, j):
        return cone(m.l_xy[i, j, 0], m.l_xy[i, j, 1], m.l[i, j])
