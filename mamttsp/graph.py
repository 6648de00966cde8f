"""The directed graph (V, E) of Section III: segments as nodes, clusters C_u, and the edges between them.

With several types of agents it has a layer for each: a depot s, a copy of every segment and an end s' of the type's
own, and edges within the layer only. A cluster C_u holds all copies of the segments of u, so a tour, which stays in
one layer, is still a path of the paper's kind, and all that is said of nodes and edges goes on to hold.
"""

import dataclasses
import functools

import numpy as np

from .instance import Instance
from .motion import TIME_SLACK
from .validation import InputError, of_type


@dataclasses.dataclass(frozen=True, eq=False)
class Graph:
    """Nodes 0 = s, 1..|V_seg| = segments (ordered by target, then time), |V_seg| + 1 = s'; edges as index pairs.

    t_lo, t_hi: (|V|,) start and end time of each node in s; p_lo, p_hi: (|V|, 2) positions there; v: (|V|, 2)
    velocities. tau: (|V|,) the target of each segment, -1 for s and s'. edges: (|E|, 2) pairs (i, j).
    horizon: T; size: the diagonal of depots, ends and paths; R: the baseline's big-M, the instance's own or else `size`.
    K types of agents have layers one after the other: kind: (|V|,) the type of each node; speeds: (K,) v_max of each
    type; capacities: (K,) infinity without a limit; demands: (n,).
    numbered: whether tours name their type (an instance that is not `plain`).
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
    kind: np.ndarray
    speeds: np.ndarray
    capacities: np.ndarray
    demands: np.ndarray
    numbered: bool

    @functools.cached_property
    def starts(self):
        """(K,) the depot s of each type, the first node of its layer."""
        return np.flatnonzero(np.r_[True, np.diff(self.kind) != 0])

    @functools.cached_property
    def ends(self):
        """(K,) the end s' of each type, the last node of its layer."""
        return np.flatnonzero(np.r_[np.diff(self.kind) != 0, True])

    @property
    def s(self):
        return int(_only(self.starts))

    @property
    def s_prime(self):
        return int(_only(self.ends))

    @property
    def max_speed(self):
        """v_max, where there is one type of agents."""
        return float(_only(self.speeds))

    @property
    def n_types(self):
        return len(self.speeds)

    @property
    def loaded(self):
        """Whether the demands exceed some capacity, so that loads matter."""
        return bool((self.demands.sum() > self.capacities).any())

    @property
    def V_seg(self):
        return np.flatnonzero(self.tau >= 0).tolist()

    @property
    def n_targets(self):
        return int(self.tau.max()) + 1

    def C(self, u):
        """Return the nodes of the cluster C_u: the segments of target u."""
        return np.flatnonzero(self.tau == u)

    def into(self, i):
        """Return the indices of E_i^in, the edges that enter node i."""
        return np.flatnonzero(self.edges[:, 1] == i)

    def out_of(self, i):
        """Return the indices of E_i^out, the edges that leave node i."""
        return np.flatnonzero(self.edges[:, 0] == i)

    def position(self, i, t):
        """Return the position (2,) of node i at time t."""
        return self.p_lo[i] + (t - self.t_lo[i]) * self.v[i]


def build_graph(instance, prune=False):
    """Return the Graph of an instance. `prune` leaves out the edges that no agent could fly in time.

    Pruning never changes an optimum: targets are slower than agents, so an agent that leaves i at its start and
    cannot reach the end of j in time cannot reach j at all, from any time in i.
    """
    of_type("instance", instance, Instance)
    V_seg = [(*segment, u) for u, target in enumerate(instance.targets) for segment in segments(target)]
    layers = [[_stop(entry.depot, 0.0), *V_seg, _stop(entry.end, instance.horizon)] for entry in instance.agents]
    t_lo, t_hi, p_lo, p_hi, v, tau = (np.array(column) for column in zip(*sum(layers, [])))
    size = len(V_seg) + 2
    edges = np.vstack([_edges(tau[:size]) + k * size for k in range(len(layers))])
    kind = np.repeat(np.arange(len(layers)), size)
    speeds = np.array([entry.max_speed for entry in instance.agents])
    if prune:
        edges = edges[_flyable(edges, t_lo, t_hi, p_lo, p_hi, speeds[kind[edges[:, 0]]])]
    R = instance.size if instance.R is None else instance.R
    return Graph(
        *(t_lo, t_hi, p_lo, p_hi, v, tau, edges, instance.horizon, instance.size, R, kind, speeds),
        capacities=np.array([np.inf if entry.capacity is None else entry.capacity for entry in instance.agents]),
        demands=np.array([target.demand for target in instance.targets]),
        numbered=not instance.plain,
    )


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


def _only(of_types):
    """Return the one entry, where there is one type of agents."""
    if len(of_types) > 1:
        raise InputError(f"agents: expected one type here, found {len(of_types)}")
    return of_types[0]


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


def _flyable(edges, t_lo, t_hi, p_lo, p_hi, max_speed):
    """Tell which edges can be flown: leave i at its start, be at the end of j when it ends."""
    i, j = edges.T
    available = t_hi[j] - t_lo[i]
    needed = np.linalg.norm(p_hi[j] - p_lo[i], axis=1) / max_speed
    return needed <= available + TIME_SLACK * (1.0 + np.abs(t_hi[j]))
