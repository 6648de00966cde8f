"""What several types of agents, and capacities, add to the cvxpy programs: fleets by layer, and loads."""

import cvxpy as cp
import numpy as np
from scipy import sparse

from .program import pick


def at_ends(graph):
    """Return the sparse (K, |E|) matrices that sum over the edges out of each layer's s and into its s'."""
    tail, head = graph.edges.T
    n_edges = len(tail)
    summed = []
    for node, stops in ((tail, graph.starts), (head, graph.ends)):
        e = np.flatnonzero(np.isin(node, stops))
        ones = np.ones(len(e)), (graph.layer[tail[e]], e)
        summed.append(sparse.csr_array(ones, shape=(graph.n_layers, n_edges)))
    return summed


def count_agents(alpha, graph):
    """Return {family: constraints}, (20) for several types: alpha (K,) agents of each fly, and at least one in all."""
    return {"number_of_agents": [alpha >= 0, alpha <= graph.counts], "some_agent_flies": [cp.sum(alpha) >= 1]}


def loads(y, q, graph):
    """Return {family: constraints} of the loads q (|E|,): what a visit adds, and what a flown edge can have."""
    tail, head = graph.edges.T
    into, out_of = (pick(node, graph).T.tocsr()[graph.V_seg] for node in (head, tail))
    demand = _demand(graph)
    added = cp.multiply(demand[graph.V_seg], into @ y)
    left = graph.room[graph.layer[tail]] - demand[head]
    most = np.where(np.isin(tail, graph.starts), np.minimum(left, 0.0), left)
    return {
        "load_conservation": [out_of @ q == into @ q + added],
        "load_at_least": [q >= cp.multiply(demand[tail], y)],
        "load_at_most": [q <= cp.multiply(most, y)],
    }


def capacity(y, graph):
    """Return the constraint that no agent serves more than its capacity; y: (|E|, m), agents of each layer."""
    head = graph.edges[:, 1]
    by_layer = (_demand(graph)[head], (graph.layer[head], np.arange(len(head))))
    served = sparse.csr_array(by_layer, shape=(graph.n_layers, len(head)))
    return served @ y <= np.tile(graph.room[:, None], y.shape[1])


def _demand(graph):
    """Return (|V|,) the demand at each node, 0 at depots and ends."""
    return np.where(graph.tau >= 0, graph.demands[graph.tau], 0.0)
