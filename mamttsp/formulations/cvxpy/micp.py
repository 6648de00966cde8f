"""The new MICP, Section IV-B, equations (17)-(29), in cvxpy."""

import cvxpy as cp

from .fleet import at_ends, count_agents, loads
from .program import Program, clusters, origins, pick


class Micp(Program):
    """One flow for all agents, with perspectives of the segments; see Program for the attributes all programs have.

    Variables, in the paper's letters: y, l, z_t, z_t_prime (|E|,); z_p, z_p_prime, l_xy (|E|, 2); alpha (), or (K,) for
    K types of agents, a layer of the graph each. Where capacities bind, q (|E|,): the load on each edge.
    """

    def _build(self):
        n_edges = len(self.graph.edges)
        self.y = cp.Variable(n_edges, name="y", boolean=True)
        self.l = cp.Variable(n_edges, name="l")
        self.z_t, self.z_t_prime = cp.Variable(n_edges, name="z_t"), cp.Variable(n_edges, name="z_t_prime")
        self.z_p, self.z_p_prime = cp.Variable((n_edges, 2), name="z_p"), cp.Variable((n_edges, 2), name="z_p_prime")
        self.l_xy = cp.Variable((n_edges, 2), name="l_xy")
        types = () if self.graph.n_layers == 1 else self.graph.n_layers
        self.alpha = cp.Variable(types, name="alpha", integer=True)
        self._depot_flow()
        self._segment_flow()
        if self.graph.loaded:
            self.q = cp.Variable(n_edges, name="q")
            self.constraints |= loads(self.y, self.q, self.graph)
        self._times()
        self._positions()
        self._lengths()
        return cp.Minimize(cp.sum(self.l))  # (17)

    def _depot_flow(self):
        """As many agents leave the depot as come back, at least one and at most m."""
        from_s, to_s_prime = at_ends(self.graph)
        self.constraints["flow_from_depot"] = [from_s @ self.y == self.alpha]  # (18)
        self.constraints["flow_to_depot"] = [to_s_prime @ self.y == self.alpha]  # (19)
        if self.graph.n_layers > 1:
            self.constraints |= count_agents(self.alpha, self.graph)  # (20)
        else:
            self.constraints["number_of_agents"] = [self.alpha >= 1, self.alpha <= self.n_agents]  # (20)

    def _segment_flow(self):
        """One unit enters each cluster; what enters a segment leaves it, at the same time."""
        tail, head = self.graph.edges.T
        V_seg = self.graph.V_seg
        into, out_of = pick(head, self.graph).T, pick(tail, self.graph).T
        self.constraints["one_segment_per_cluster"] = [clusters(self.graph) @ into @ self.y == 1]  # (21)
        into, out_of = into.tocsr()[V_seg], out_of.tocsr()[V_seg]
        self.constraints["flow_conservation"] = [into @ self.y == out_of @ self.y]  # (22), second component
        self.constraints["time_conservation"] = [into @ self.z_t_prime == out_of @ self.z_t]  # (22), first component

    def _times(self):
        """z_t and z'_t lie in y times the time window of the tail and of the head."""
        tail, head = self.graph.edges.T
        self.constraints["time_at_tail"] = self._in_window(self.z_t, tail)  # (23)
        self.constraints["time_at_head"] = self._in_window(self.z_t_prime, head)  # (24)

    def _in_window(self, z_t, node):
        t_lo, t_hi = self.graph.t_lo[node], self.graph.t_hi[node]
        return [cp.multiply(t_lo, self.y) <= z_t, z_t <= cp.multiply(t_hi, self.y)]

    def _positions(self):
        """z_p and z'_p lie on the tail's and on the head's motion."""
        tail, head = self.graph.edges.T
        self.constraints["position_at_tail"] = [self.z_p == self._on_motion(self.z_t, tail)]  # (25)
        self.constraints["position_at_head"] = [self.z_p_prime == self._on_motion(self.z_t_prime, head)]  # (26)

    def _on_motion(self, z_t, node):
        v, origin = self.graph.v[node], origins(self.graph)[node]
        return cp.vstack([cp.multiply(v[:, k], z_t) + cp.multiply(origin[:, k], self.y) for k in (0, 1)]).T

    def _lengths(self):
        """l is at least the distance between the two positions, and can be flown in the time between them."""
        elapsed = self.z_t_prime - self.z_t
        v_max = self.graph.speeds[self.graph.layer[self.graph.edges[:, 0]]]
        self.constraints["speed"] = [self.l <= cp.multiply(v_max, elapsed)]  # (27)
        self.constraints["displacement"] = [self.l_xy == self.z_p_prime - self.z_p]  # (28)
        self.constraints["norm"] = [cp.SOC(self.l, self.l_xy, axis=1)]  # (29)
