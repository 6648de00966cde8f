"""Settling a set partitioning whose costs are lower bounds: the competing sets of targets get exact costs.

A column is a set of targets with a lower bound on its shortest route, so the best choice of columns is a bound on every
solution. A set in it that is not settled has all its sequences of segments timed by the SOCP, which raises its bound to
its cost, and the choice is made anew: first by the linear relaxation, which is quick and drops most columns by their
reduced costs, then in whole columns. Only the few sets that compete are ever settled.
"""

import numpy as np

from .enumeration import membership
from .partition import choose, relax_choice


class Sets:
    """The competing sets of targets of an enumeration's columns, the same set with other agents another one.

    members: (n, J) sparse 0/1; agents: (J,) layers of the graph; cost: (J,) lower bounds; settled: (J,) bool; columns:
    of each set the columns that it comes from.
    """

    def __init__(self, visited, agents, cost, n_targets):
        key = np.c_[visited, agents.astype(np.uint64)]
        unique, of_column = np.unique(key, axis=0, return_inverse=True)
        order = np.argsort(of_column, kind="stable")
        ends = np.searchsorted(of_column[order], np.arange(len(unique) + 1))
        self.columns = [order[start:end] for start, end in zip(ends[:-1], ends[1:])]
        self.of_column = of_column
        self.cost = np.full(len(unique), np.inf)
        np.minimum.at(self.cost, of_column, cost)
        self.settled = np.zeros(len(unique), dtype=bool)
        self.members, self.agents = membership(unique, n_targets), unique[:, -1].astype(int)

    def keep(self, which):
        """Drop all other sets."""
        self.cost, self.settled, self.agents = self.cost[which], self.settled[which], self.agents[which]
        self.members = self.members[:, which]
        self.columns = [columns for columns, kept in zip(self.columns, which) if kept]


def settle(sets, fleet, limit, unit, parameters, settle_set, on_bound, clock):
    """Settle sets until nothing below the limit is left, the choice is all settled, or time is up; return (done,
    chosen): whether nothing is left to do, and the columns of each set of a best choice, all settled, if that is why.

    limit(): value from which solutions need not be looked at, it may fall on the way; settle_set(columns): the least
    cost of the set's routes below the limit, infinite if there is none, None if that cannot be told; on_bound(bound):
    told each bound.
    """
    rows = None
    while not clock.out():
        relaxed = relax_choice(
            sets.members, sets.agents, sets.cost, fleet, limit(), unit, parameters, clock.seconds, rows
        )  # fmt: skip
        if relaxed is None:
            break
        rows = relaxed.rows
        bound, alive = relaxed.bound, relaxed.slack >= 0.0
        alive[relaxed.support] = True
        competing = (np.cumsum(alive) - 1)[relaxed.support]
        sets.keep(alive)
        if bound < limit() and sets.settled[competing].all():
            bound, competing = choose(sets.members, sets.agents, sets.cost, fleet, limit(), unit, clock.seconds)
        on_bound(min(bound, limit()))
        if bound >= limit() or competing is None:
            return bound >= limit(), []
        if sets.settled[competing].all():
            return True, [sets.columns[j] for j in competing]
        for j in competing:
            if not sets.settled[j] and not clock.out():
                cost = settle_set(sets.columns[j])
                if cost is None:
                    return False, []
                sets.cost[j] = max(sets.cost[j], min(cost, 2.0 * limit() + unit))
                sets.settled[j] = True
    return False, []
