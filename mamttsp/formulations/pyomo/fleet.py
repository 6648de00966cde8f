"""What several types of agents, and capacities, add to the Pyomo models and change in them.

The graph has a layer for each type in the MICP, for each agent in the models by agent, so that all other equations hold
as they are. Each family here says which of the paper's it generalises.
"""

from functools import partial

import pyomo.environ as pyo

from .network import sum_in


def add_depot_flow_by_type(m, graph):
    """Add (18)-(20) with a flow alpha_k for each layer k; m has y."""
    m.V_typ = pyo.RangeSet(0, graph.n_layers - 1)
    m.alpha = pyo.Var(m.V_typ, domain=pyo.Integers, doc="alpha_k: number of agents of type k that fly")
    y, alpha, total, count = m.y, m.alpha, partial(sum_in, m), graph.counts.tolist()
    s, s_prime = graph.starts.tolist(), graph.ends.tolist()

    @m.Constraint(m.V_typ, doc="(18) for each type: alpha_k agents leave its depot.")
    def flow_from_depot(m, k):
        return total(y[e] for e in m.E_out[s[k]]) == alpha[k]

    @m.Constraint(m.V_typ, doc="(19) for each type: alpha_k agents come to its end.")
    def flow_to_depot(m, k):
        return total(y[e] for e in m.E_in[s_prime[k]]) == alpha[k]

    @m.Constraint(m.V_typ, doc="(20) for each type: no more agents than there are.")
    def number_of_agents(m, k):
        return pyo.inequality(0, alpha[k], count[k])

    @m.Constraint(doc="(20) for all types: at least one agent flies.")
    def some_agent_flies(m):
        return pyo.quicksum(alpha[k] for k in m.V_typ) >= 1


def add_loads(m, graph):
    """Add the load q on each edge, a flow of demands within the capacities; m has y."""
    E, y, E_in, E_out, total = m.E, m.y, m.E_in, m.E_out, partial(sum_in, m)
    d, least, most = _demands(graph), *_load_limits(graph)
    m.q = pyo.Var(E, doc="q_e: demand served before the end of edge e, 0 if e is not flown")

    @m.Constraint(m.V_seg, doc="(22) for loads: a visit adds its demand to the load.")
    def load_conservation(m, i):
        served = d[i] * total(y[e] for e in E_in[i])
        return total(m.q[e] for e in E_out[i]) == total(m.q[e] for e in E_in[i]) + served

    @m.Constraint(E, doc="(23) for loads: if e is flown, its load has the demand of its tail...")
    def load_at_least(m, i, j):
        return m.q[i, j] >= least[i, j] * y[i, j]

    @m.Constraint(E, doc="(23) for loads: ... and leaves room for the demand of its head.")
    def load_at_most(m, i, j):
        return m.q[i, j] <= most[i, j] * y[i, j]


def add_depot_flow_by_agent(m, graph):
    """Add (2) and (3) where each agent has a layer; m has y[i, j, 1]."""
    m.L = pyo.RangeSet(0, graph.n_layers - 1)
    y, total = m.y, partial(sum_in, m)
    s, s_prime = graph.starts.tolist(), graph.ends.tolist()

    @m.Constraint(m.L, doc="(2) for agents of several types: each leaves its own depot at most once.")
    def depot_flow_out(m, k):
        return total(y[e, 1] for e in m.E_out[s[k]]) <= 1

    @m.Constraint(m.L, doc="(3) for agents of several types: each comes to its own end at most once.")
    def depot_flow_in(m, k):
        return total(y[e, 1] for e in m.E_in[s_prime[k]]) <= 1


def add_capacity(m, graph):
    """Add the capacity of each agent; m has y[i, j, k], agents k of each layer."""
    m.L = m.component("L") or pyo.RangeSet(0, graph.n_layers - 1)
    d, room = _demands(graph), graph.room.tolist()
    layer = graph.layer.tolist()

    @m.Constraint(m.L, m.V_agt, doc="(new) An agent serves no more demand than its capacity.")
    def capacity(m, a, k):
        served = [d[j] * m.y[i, j, k] for i, j in m.E if layer[j] == a and d[j] > 0]
        return sum_in(m, served) <= room[a]


def _demands(graph):
    """Return the demand at each node as a list, 0 at depots and ends."""
    return [graph.demands[u] if u >= 0 else 0.0 for u in graph.tau.tolist()]


def _load_limits(graph):
    """Return ({e: least}, {e: most}) of the load of an edge that is flown; from a depot it is 0, or nothing fits."""
    d, room, start = _demands(graph), graph.room[graph.layer].tolist(), set(graph.starts.tolist())
    edges = [tuple(e) for e in graph.edges.tolist()]
    most = {(i, j): room[i] - d[j] for i, j in edges}
    return {(i, j): d[i] for i, j in edges}, {
        e: min(limit, 0.0) if e[0] in start else limit for e, limit in most.items()
    }
