"""Subset-row cuts on three targets (Jepsen, Petersen, Spoorendonk and Pisinger 2008) with limited memory (Pecin 2017).

Of the routes that serve at least two of three targets a solution uses at most one. A route pays the price of a cut each
time it makes a second visit to a target of its row, counted anew whenever it leaves the cut's memory, a set of targets.
"""

import dataclasses

import numpy as np

from ..compiled import compiled

#: cuts are bits of one word
MOST_CUTS = 63


@dataclasses.dataclass(frozen=True, eq=False)
class Cuts:
    """rows: (C, n) bool, three targets each; memory: (C, n) bool; sigma: (C,) prices <= 0."""

    rows: np.ndarray
    memory: np.ndarray
    sigma: np.ndarray

    @classmethod
    def none(cls, n_targets):
        return cls(np.zeros((0, n_targets), bool), np.zeros((0, n_targets), bool), np.zeros(0))

    def with_prices(self, sigma):
        return dataclasses.replace(self, sigma=sigma)

    def with_more(self, rows, memory):
        """Return the cuts with more of them, at no price."""
        return Cuts(
            np.vstack([self.rows, rows]), np.vstack([self.memory, memory]), np.r_[self.sigma, [0.0] * len(rows)]
        )

    @property
    def words(self):
        """(inside, kept), each (n,) uint64, and (64,) sigma: as in `ngroutes.Prices`."""
        bits = np.uint64(1) << np.arange(len(self.rows), dtype=np.uint64)
        inside, kept = ((mark * bits[:, None]).sum(axis=0, dtype=np.uint64) for mark in (self.rows, self.memory))
        return inside, kept, np.r_[self.sigma, np.zeros(64 - len(self.sigma))]

    def price_of(self, members):
        """Return (J,) what routes that visit the targets in members (n, J) once pay, <= 0."""
        if not len(self.rows):
            return np.zeros(members.shape[1])
        return self.sigma @ np.floor((self.rows.astype(float) @ members) / 2.0)

    def paid(self, routes):
        """Return (J, C) how often each route, a sequence of targets, pays each cut."""
        inside, kept, _ = self.words
        return np.array([times_paid(route, inside, kept) for route in routes]).reshape(-1, 64)[:, : len(self.rows)]


@compiled
def times_paid(route, inside, kept):
    """Return (64,) how often a route, a sequence of targets, pays each cut."""
    times, odd = np.zeros(64), np.uint64(0)
    for u in route:
        odd &= kept[u]
        hits = odd & inside[u]
        odd ^= inside[u]
        for bit in range(64):
            times[bit] += (hits >> np.uint64(bit)) & np.uint64(1)
    return times


def separate(routes, level, n_targets, most, least_violation):
    """Return (rows, memory), each (C, n) bool: up to `most` violated cuts, the most violated first.

    routes: sequences of targets with the given level (J,) > 0 in a linear program's solution.
    """
    visits = np.array([np.bincount(route, minlength=n_targets) for route in routes], dtype=np.int8)
    every = np.arange(n_targets)
    i, j, k = np.nonzero((every[:, None, None] > every[:, None]) & (every[:, None] > every))
    total = np.zeros(len(i))
    for visit, share in zip(visits, level):
        total += share * ((visit[i] + visit[j] + visit[k]) // 2)
    best = np.argsort(-total, kind="stable")[:most]
    best = best[total[best] > 1.0 + least_violation]
    rows, memory = np.zeros((2, len(best), n_targets), bool)
    for c, row in enumerate(zip(i[best], j[best], k[best])):
        rows[c, list(row)] = True
        memory[c] = _memory(routes, rows[c])
    return rows, memory


def _memory(routes, row):
    """Return (n,) the least memory with which the routes pay for every second visit."""
    memory = row.copy()
    for route in routes:
        visits = np.flatnonzero(row[route])
        for first, second in zip(visits[::2], visits[1::2]):
            memory[route[first : second + 1]] = True
    return memory
