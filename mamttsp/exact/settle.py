"""Settling a set partitioning whose costs are lower bounds: the competing sets of targets get exact costs.

A column is a set of targets with a lower bound on its cheapest route, so the best choice of columns is a bound on every
solution. A set in it that is not settled is solved as a small single-agent instance of its own, which raises its bound
to its cost (or beyond use), and the choice is made anew: first by the linear relaxation, which is quick and drops most
columns by their reduced costs, then in whole columns. Only the few sets that compete are ever settled.
"""

import numpy as np
from scipy import sparse

from .partition import choose, relax_choice


class Sets:
    """The competing sets of targets. visited: (J,) uint64; members: (n, J) sparse 0/1; cost: (J,) lower bounds;
    settled: (J,) bool; of_column: the set of each of the columns that they were made from."""

    def __init__(self, visited, cost, n_targets):
        self.visited, self.of_column = np.unique(visited, return_inverse=True)
        self.cost = np.full(len(self.visited), np.inf)
        np.minimum.at(self.cost, self.of_column, cost)
        self.settled = np.zeros(len(self.cost), dtype=bool)
        self.members = members(self.visited, n_targets)

    def targets(self, j):
        """Return the targets of a set."""
        return tuple(int(u) for u in self.members.indices[self.members.indptr[j] : self.members.indptr[j + 1]])

    def keep(self, which):
        """Drop all other sets."""
        self.visited, self.cost, self.settled = self.visited[which], self.cost[which], self.settled[which]
        self.members, self.of_column = self.members[:, which], None


def members(visited, n_targets):
    """Return the (n, J) sparse 0/1 matrix of targets by sets."""
    bits = (visited[None, :] >> np.arange(n_targets, dtype=np.uint64)[:, None]) & np.uint64(1)
    return sparse.csc_matrix(bits.astype(float))


def settle(sets, n_agents, limit, solve_set, on_bound, out_of_time):
    """Settle sets until nothing below the limit is left, the choice is all settled, or time is up.

    limit(): value from which solutions need not be looked at, it may fall on the way; solve_set(targets, cutoff, dual):
    lower bound on the set's cheapest route, its cost if that is below the cutoff, dual: (n,) prices of all targets to
    start from; on_bound(bound): told each bound.
    """
    while not out_of_time():
        relaxed = relax_choice(sets.members, sets.cost, n_agents, limit())
        alive = relaxed.slack >= 0.0
        competing, bound = relaxed.support, relaxed.bound
        if sets.settled[competing].all():
            sets.keep(alive)
            slack = relaxed.slack[alive]
            bound, competing = choose(sets.members, sets.cost, n_agents)
        else:
            slack = relaxed.slack
        on_bound(min(bound, limit()))
        if competing is None or bound >= limit() or sets.settled[competing].all():
            return
        for j in competing:
            if not sets.settled[j] and not out_of_time():
                # Beyond its slack the set cannot be part of a solution within the limit.
                sets.cost[j] = max(
                    sets.cost[j], solve_set(sets.targets(j), sets.cost[j] + max(slack[j], 0.0), relaxed.dual)
                )
                sets.settled[j] = True
