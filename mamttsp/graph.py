"""The directed graph (V, E) of Section III: segments as nodes, clusters C_u, and the edges between them."""

import dataclasses

import numpy as np

from .instance import Instance
from .motion import TIME_SLACK
from .validation import of_type


@dataclasses.dataclass(frozen=True, eq=False)
class Graph:
    """Nodes 0 = s, 1..|V_seg| = segments (ordered by target, then time), |V_seg| + 1 = s'; edges as index pairs.

    t_lo, t_hi: (|V|,) start and end time of each node in s; p_lo, p_hi: (|V|, 2) positions there; v: (|V|, 2)
    velocities. tau: (|V|,) the target of each segment, -1 for s and s'. edges: (|E|, 2) pairs (i, j).
    max_speed: v_max; horizon: T; size: the diagonal of depot and paths; R: the baseline's big-M, the
    instance's own or else `size`.
    """

    t_lo: np.ndarray
    t_hi: np.ndarray
    p_lo: np.ndarray
    p_hi: np.ndarray
    v: np.ndarray
    tau: np.ndarray
    edges: np.ndarray
    max_speed: float
    horizon: float
    size: float
    R: float

    @property
    def s(self):
        return 0

    @property
    def s_prime(self):
        return len(self.tau) - 1

    @property
    def V_seg(self):
        return range(1, self.s_prime)

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
    rows = [_depot_row(instance, 0.0, 0.0)]
    for u, target in enumerate(instance.targets):
        rows += [(*segment, u) for segment in segments(target)]
    rows.append(_depot_row(instance, 0.0, instance.horizon))
    t_lo, t_hi, p_lo, p_hi, v, tau = (np.array(column) for column in zip(*rows))
    edges = _edges(tau)
    if prune:
        edges = edges[_flyable(edges, t_lo, t_hi, p_lo, p_hi, instance.max_speed)]
    R = instance.size if instance.R is None else instance.R
    return Graph(t_lo, t_hi, p_lo, p_hi, v, tau, edges, instance.max_speed, instance.horizon, instance.size, R)


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


def _depot_row(instance, t_lo, t_hi):
    return t_lo, t_hi, instance.depot, instance.depot, np.zeros(2), -1


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
