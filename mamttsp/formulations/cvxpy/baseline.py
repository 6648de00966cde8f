"""The baseline MICP with big-M, Section III, equations (1)-(10), in cvxpy."""

import cvxpy as cp
import numpy as np

from .fleet import at_ends, capacity
from .program import Program, clusters, origins, pick


class Baseline(Program):
    """A flow for each agent, and lengths that big-M switches off; see Program for the attributes all programs have.

    Variables, in the paper's letters: t (|V|, m); y, l, l_bar (|E|, m); l_xy, a list of its components, (|E|, m) each.
    m counts the agents of the one layer of the graph; where it has several, each is that of one agent, and m is 1.
    """

    def _build(self):
        n_nodes, n_edges, m = len(self.graph.tau), len(self.graph.edges), self.n_columns
        self.y = cp.Variable((n_edges, m), name="y", boolean=True)
        self.t = cp.Variable((n_nodes, m), name="t")
        self.l = cp.Variable((n_edges, m), name="l", nonneg=True)
        self.l_bar = cp.Variable((n_edges, m), name="l_bar", nonneg=True)
        self.l_xy = [cp.Variable((n_edges, m), name=f"l_{axis}") for axis in "xy"]
        self._flows()
        self._times()
        self._lengths()
        return cp.Minimize(cp.sum(self.l))  # (1)

    def _flows(self):
        """Each agent leaves and enters the depot at most once; every target is entered once, by one of the agents."""
        graph, y = self.graph, self.y
        tail, head = graph.edges.T
        into, out_of = pick(head, graph).T, pick(tail, graph).T
        from_s, to_s_prime = at_ends(graph)
        self.constraints["depot_flow_out"] = [from_s @ y <= 1]  # (2)
        self.constraints["depot_flow_in"] = [to_s_prime @ y <= 1]  # (3)
        self.constraints["target_flow_in"] = [cp.sum(clusters(graph) @ into @ y, axis=1) == 1]  # (4)
        balance = (into - out_of).tocsr()[graph.V_seg]
        self.constraints["flow_conservation"] = [balance @ y == 0]  # (5)
        if graph.loaded:
            self.constraints["capacity"] = [capacity(y, graph)]

    def _times(self):
        """Every agent has a time at every node, inside the node's window."""
        t_lo, t_hi = (np.tile(t[:, None], self.n_columns) for t in (self.graph.t_lo, self.graph.t_hi))
        self.constraints["node_time_window"] = [t_lo <= self.t, self.t <= t_hi]  # (6)

    def _lengths(self):
        """l is at least the distance flown and can be flown in time, unless big-M (T and R) switches that off."""
        graph = self.graph
        tail, head = graph.edges.T
        elapsed = (pick(head, graph) - pick(tail, graph)) @ self.t
        v_max = np.tile(graph.speeds[graph.layer[tail], None], self.n_columns)
        freed = graph.horizon * (1 - self.y)
        self.constraints["speed"] = [self.l <= cp.multiply(v_max, elapsed + freed)]  # (7)
        self.constraints["displacement"] = [self.l_xy[k] == self._displacement(k) for k in (0, 1)]  # (8)
        self.constraints["big_m"] = [self.l_bar == self.l + graph.R * (1 - self.y)]  # (9)
        flat = [cp.vec(x, order="F") for x in (self.l_bar, *self.l_xy)]
        self.constraints["norm"] = [cp.SOC(flat[0], cp.vstack(flat[1:]))]  # (10)

    def _displacement(self, axis):
        """Return (|E|, m): head's minus tail's position on their motions, one coordinate of it."""
        graph = self.graph
        tail, head = graph.edges.T
        v, origin = graph.v[:, axis], origins(graph)[:, axis]
        along = (pick(head, graph, v[head]) - pick(tail, graph, v[tail])) @ self.t
        return along + np.tile((origin[head] - origin[tail])[:, None], self.n_columns)
