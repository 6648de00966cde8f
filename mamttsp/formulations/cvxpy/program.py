"""What the cvxpy programs share: families of constraints by name, cuts, and matrices over nodes and edges."""

import abc

import cvxpy as cp
import numpy as np
from scipy import sparse


class Program(abc.ABC):
    """A formulation on a graph for `n_agents` agents as a cvxpy program.

    constraints: dict from the name of each family of constraints to its list of cvxpy constraints; problem: the
    cp.Problem of all of them.
    """

    def __init__(self, graph, n_agents):
        self.graph, self.n_agents = graph, n_agents
        self.n_columns = n_agents if graph.n_layers == 1 else 1  # agents who share a layer
        self.constraints = {}
        objective = self._build()
        self.problem = cp.Problem(objective, sum(self.constraints.values(), []))

    @abc.abstractmethod
    def _build(self):
        """Create the variables, fill `constraints`, and return the objective."""

    def add_cut(self, cut):
        """Add a cvxpy constraint to the family `subtour_cuts`."""
        self.constraints.setdefault("subtour_cuts", []).append(cut)
        self.problem = cp.Problem(self.problem.objective, [*self.problem.constraints, cut])


def pick(nodes, graph, weights=None):
    """Return the sparse (|E|, |V|) matrix that picks for each edge its entry of `nodes`, times its weight."""
    n_edges = len(graph.edges)
    weights = np.ones(n_edges) if weights is None else weights
    return sparse.csr_array((weights, (np.arange(n_edges), nodes)), shape=(n_edges, len(graph.tau)))


def clusters(graph):
    """Return the sparse (n, |V|) matrix with a one where a node is a segment of a target."""
    V_seg = np.asarray(graph.V_seg)
    return sparse.csr_array((np.ones(len(V_seg)), (graph.tau[V_seg], V_seg)), shape=(graph.n_targets, len(graph.tau)))


def origins(graph):
    """Return (|V|, 2): where each node's motion, extended, would be at time 0, p_lo - t_lo v."""
    return graph.p_lo - graph.t_lo[:, None] * graph.v
