"""The directed graph (V, E) of Section III: segments as nodes, clusters C_u, and the edges between them.

With several types of agents it has a layer for each: a depot s, a copy of every segment and an end s' of the type's
own, and edges within the layer only. A cluster C_u holds all copies of the segments of u, so a tour, which stays in
one layer, is still a path of the paper's kind, and all that is said of nodes and edges goes on to hold.
"""

import dataclasses
import functools
import itertools
import math

import numpy as np

from .instance import Instance
from .motion import TIME_SLACK
from .validation import InputError, of_type, whole

#: relative slack within which a sum of demands is no more than a capacity
LOAD_SLACK = 1e-9


@dataclasses.dataclass(frozen=True, eq=False)
class Graph:
    """Nodes 0 = s, 1..|V_seg| = segments (ordered by target, then time), |V_seg| + 1 = s'; edges as index pairs.

    t_lo, t_hi: (|V|,) start and end time of each node in s; p_lo, p_hi: (|V|, 2) positions there; v: (|V|, 2)
    velocities. tau: (|V|,) the target of each segment, -1 for s and s'. edges: (|E|, 2) pairs (i, j).
    horizon: T; size: the diagonal of depots, ends and paths; R: the baseline's big-M, the instance's own or `size`.

    There are K layers, one after the other, each of a type of agents. layer: (|V|,) the layer of each node; types: (K,)
    which entry of `Instance.agents`; counts: (K,) how many; speeds: (K,) v_max; capacities: (K,) infinity without a
    limit. demands: (n,). numbered: whether tours name their type, as those of an instance that is not `plain` do.

    >>> from mamttsp import build_graph, generate
    >>> graph = build_graph(generate(n_targets=3, total_window=20, seed=1))
    >>> graph.n_layers, graph.n_targets, graph.max_speed
    (1, 3, 4.0)
    """

    t_lo: np.ndarray
    t_hi: np.ndarray
    p_lo: np.ndarray
    p_hi: np.ndarray
    v: np.ndarray
    tau: np.ndarray
    edges: np.ndarray
    horizon: float
    size: float
    R: float
    layer: np.ndarray
    types: np.ndarray
    counts: np.ndarray
    speeds: np.ndarray
    capacities: np.ndarray
    demands: np.ndarray
    numbered: bool

    @functools.cached_property
    def starts(self):
        """(K,) the depot s of each layer, its first node."""
        return np.searchsorted(self.layer, np.arange(self.n_layers))

    @functools.cached_property
    def ends(self):
        """(K,) the end s' of each layer, its last node."""
        return np.searchsorted(self.layer, np.arange(self.n_layers), side="right") - 1

    @property
    def s(self) -> int:
        return int(_only(self.starts))

    @property
    def s_prime(self) -> int:
        return int(_only(self.ends))

    @property
    def max_speed(self) -> float:
        """v_max, where there is one layer."""
        return float(_only(self.speeds))

    @property
    def n_layers(self) -> int:
        return len(self.types)

    @property
    def room(self):
        """(K,) what an agent of each layer can carry: its capacity or all demands, and what rounding may add."""
        return np.minimum(self.capacities, self.demands.sum()) * (1.0 + LOAD_SLACK)

    @property
    def loaded(self):
        """Whether the demands exceed some capacity, so that loads matter."""
        return bool((self.room < self.demands.sum()).any())

    @property
    def V_seg(self) -> list[int]:
        return np.flatnonzero(self.tau >= 0).tolist()

    @property
    def n_targets(self) -> int:
        return int(self.tau.max()) + 1

    def C(self, u: int) -> np.ndarray:
        """Return the nodes of the cluster C_u: the segments of target u."""
        return np.flatnonzero(self.tau == whole("u", u, 0))

    def into(self, i: int) -> np.ndarray:
        """Return the indices of E_i^in, the edges that enter node i."""
        return np.flatnonzero(self.edges[:, 1] == whole("i", i, 0))

    def out_of(self, i: int) -> np.ndarray:
        """Return the indices of E_i^out, the edges that leave node i."""
        return np.flatnonzero(self.edges[:, 0] == whole("i", i, 0))

    def position(self, i: int, t: float) -> np.ndarray:
        """Return the position (2,) of node i at time t."""
        whole("i", i, 0)
        return self.p_lo[i] + (t - self.t_lo[i]) * self.v[i]


def build_graph(instance: Instance, prune: bool = False, by_agent: bool = False) -> Graph:
    """Return the Graph of an instance, with a layer for each type of agents, or with `by_agent` for each agent.

    prune: leave out the edges that no agent of the layer could fly in time, or for lack of capacity. It never changes
    an optimum: targets are slower than agents, so an agent that leaves i at its start and cannot reach the end of j in
    time cannot reach j at all, from any time in i.

    >>> from mamttsp import build_graph, paper_instance
    >>> graph = build_graph(paper_instance(5, 0, total_window=20))
    >>> graph.s, graph.s_prime, graph.C(0).tolist()
    (0, 14, [1, 2])
    >>> len(graph.edges)
    160
    """
    of_type("instance", instance, Instance)
    types = np.repeat(np.arange(len(instance.agents)), instance.counts if by_agent else 1)
    entries = [instance.agents[number] for number in types]
    V_seg = [(*segment, u) for u, target in enumerate(instance.targets) for segment in segments(target)]
    rows = [[_stop(entry.depot, 0.0), *V_seg, _stop(entry.end, instance.horizon)] for entry in entries]
    t_lo, t_hi, p_lo, p_hi, v, tau = (np.array(column) for column in zip(*itertools.chain.from_iterable(rows)))
    size = len(V_seg) + 2
    graph = Graph(
        *(t_lo, t_hi, p_lo, p_hi, v, tau),
        edges=np.vstack([_edges(tau[:size]) + k * size for k in range(len(entries))]),
        horizon=instance.horizon,
        size=instance.size,
        R=instance.size if instance.R is None else instance.R,
        layer=np.repeat(np.arange(len(entries)), size),
        types=types,
        counts=np.array([1 if by_agent else entry.count for entry in entries]),
        speeds=np.array([entry.max_speed for entry in entries]),
        capacities=np.array([math.inf if entry.capacity is None else entry.capacity for entry in entries]),
        demands=np.array([target.demand for target in instance.targets]),
        numbered=not instance.plain,
    )
    return dataclasses.replace(graph, edges=graph.edges[_flyable(graph)]) if prune else graph


def segments(target):
    """Return the linear segments of a target's windows, cut at its bends: (t_lo, t_hi, p_lo, p_hi, v) each."""
    found = []
    for start, end in target.windows:
        bends = target.times[(target.times > start) & (target.times < end)]
        cuts = [start, *bends, end]
        for t_lo, t_hi in zip(cuts[:-1], cuts[1:]):
            found.append((t_lo, t_hi, target.position(t_lo), target.position(t_hi), _velocity(target, t_lo, t_hi)))
    return found


def _velocity(target, t_lo, t_hi):
    piece = np.clip(np.searchsorted(target.times, (t_lo + t_hi) / 2, side="right") - 1, 0, len(target.times) - 2)
    return np.diff(target.points, axis=0)[piece] / np.diff(target.times)[piece]


def _stop(place, latest):
    """Return the row of a node that stands still at `place` from time 0 on: s or s'."""
    return 0.0, latest, place, place, np.zeros(2), -1


def _only(of_layers):
    """Return the one entry, where there is one layer."""
    if len(of_layers) > 1:
        raise InputError(f"agents: expected one type here, found {len(of_layers)}")
    return of_layers[0]


def _edges(tau):
    """From s to every segment, between segments of different targets, and from every segment to s'."""
    last = len(tau) - 1
    V_seg = np.arange(1, last)
    tail, head = np.meshgrid(V_seg, V_seg, indexing="ij")
    across = tau[tail] != tau[head]
    return np.vstack(
        [
            np.stack([np.zeros_like(V_seg), V_seg], axis=1),
            np.stack([tail[across], head[across]], axis=1),
            np.stack([V_seg, np.full_like(V_seg, last)], axis=1),
        ]
    )


def _flyable(graph):
    """Tell which edges can be flown: leave i at its start, be at the end of j when it ends, and carry both demands."""
    i, j = graph.edges.T
    layer, demand = graph.layer[i], np.where(graph.tau >= 0, graph.demands[graph.tau], 0.0)
    available = graph.t_hi[j] - graph.t_lo[i]
    needed = np.linalg.norm(graph.p_hi[j] - graph.p_lo[i], axis=1) / graph.speeds[layer]
    in_time = needed <= available + TIME_SLACK * (1.0 + np.abs(graph.t_hi[j]))
    return in_time & (demand[i] + demand[j] <= graph.room[layer])
