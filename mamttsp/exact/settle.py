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
    """The competing sets of targets. targets: list of tuples; members: (n, J) sparse 0/1; cost: (J,) lower bounds;
    settled: (J,) bool."""

    def __init__(self, members, cost):
        keys = [tuple(members.indices[members.indptr[j] : members.indptr[j + 1]]) for j in range(members.shape[1])]
        cheapest = {}
        for key, value in zip(keys, cost):
            cheapest[key] = min(value, cheapest.get(key, np.inf))
        self.targets = list(cheapest)
        self.cost = np.array(list(cheapest.values()))
        self.settled = np.zeros(len(self.cost), dtype=bool)
        rows = np.concatenate([np.array(key) for key in self.targets])
        columns = np.repeat(np.arange(len(self.targets)), [len(key) for key in self.targets])
        self.members = sparse.csc_matrix((np.ones(len(rows)), (rows, columns)), shape=(members.shape[0], len(self.cost)))

    def keep(self, which):
        self.targets = [key for key, kept in zip(self.targets, which) if kept]
        self.cost, self.settled, self.members = self.cost[which], self.settled[which], self.members[:, which]


def settle(sets, n_agents, limit, solve_set, on_bound, out_of_time):
    """Settle sets until nothing below the limit is left, the choice is all settled, or time is up.

    limit(): value from which solutions need not be looked at, it may fall on the way; solve_set(targets, cutoff): lower
    bound on the set's cheapest route, which is its cost if that is below the cutoff; on_bound(bound): told each bound.
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
                sets.cost[j] = max(sets.cost[j], solve_set(sets.targets[j], sets.cost[j] + max(slack[j], 0.0)))
                sets.settled[j] = True
