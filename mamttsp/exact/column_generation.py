"""Column generation: prices that raise the Lagrangian bound, from a restricted master problem over ng-routes.

The master is stabilised by a box around the best prices so far (boxstep): targets may be served at the upper price of
the box or given back at the lower one.
"""

import contextlib
import copy
import dataclasses
import time

import numpy as np

from . import ngsets
from .cuts import Cuts
from .evaluation import NO_LIMITS, Limits, evaluate, restricted
from .ngroutes import Unfinished
from .restricted_master import RestrictedMaster


@dataclasses.dataclass
class Columns:
    """Columns of the master: routes as sequences of targets and of segments, their agents (layers) and lengths."""

    routes: list
    segments: list
    agents: list
    lengths: list

    def keep(self, which):
        for name in ("routes", "segments", "agents", "lengths"):
            setattr(self, name, [entry for entry, kept in zip(getattr(self, name), which) if kept])


class ColumnGeneration:
    """Column generation over one network after another; what it knows of routes and prices is taken along.

    best: the Evaluation of the greatest bound over the present network, ng-sets and cuts, None before the first;
    support: (route, level, layer) of the master's columns in use; decisions: see `splitting`; rolled_back: whether
    `roll_back` was called; work: entries extended along arcs so far; lasted: seconds of the latest evaluation of all
    entries, at first about what it will take: none begins that would end too late.
    """

    def __init__(self, network, n_targets, fleet, pi, parameters, unit):
        self.network, self.n, self.fleet, self.parameters, self.unit = network, n_targets, fleet, parameters, unit
        self.pi, self.cuts, self.best, self.support = pi, Cuts.none(n_targets), None, []
        self.box, self.dropped_at, self.work, self.decisions, self._near = np.inf, np.inf, 0, (), None
        self.N = ngsets.nearest(network.pieces, network.arcs, n_targets, parameters.ng_size)
        self.rolled_back = False
        self.columns, self.tried = Columns([], [], [], []), []
        self.lasted = len(network.arcs.head) / parameters.arcs_rate
        self._fresh_master()

    def _fresh_master(self):
        self.master = RestrictedMaster(self.n, self.fleet, len(self.cuts.rows), self.unit)
        self._add(self.columns.routes, self.columns.agents, self.columns.lengths)

    def _add(self, routes, agents, lengths):
        visits = np.array([np.bincount(route, minlength=self.n) for route in routes], dtype=float).reshape(-1, self.n)
        self.master.add(visits, agents, lengths, self.cuts.paid(routes))

    @property
    def tolerance(self):
        """A change of a value that counts as none."""
        return 1e-9 * self.unit

    def offer(self, routes, segments, agents, lengths):
        """Add columns: sequences of targets and of segments, their layers and lengths."""
        self.columns.routes += routes
        self.columns.segments += segments
        self.columns.agents += agents
        self.columns.lengths += lengths
        self._add(routes, agents, lengths)

    def offer_incumbent(self, incumbent):
        """Add the incumbent's routes."""
        for route in incumbent.routes:
            targets, layer = incumbent.graph.tau[list(route)], int(incumbent.graph.layer[route[0]])
            if route not in self.columns.segments and all(d.permits(targets, layer) for d in self.decisions):
                self.offer([targets], [route], [layer], [incumbent.timed(route)[0]])

    def moved(self, network):
        """Go on over another network; lengths of columns over the old one are forgotten."""
        self.network, self.best, self.dropped_at, self._near = network, None, np.inf, None
        self.columns, self.tried = Columns([], [], [], []), []
        self._fresh_master()

    def narrowed(self, network):
        """Go on over a part of the present network."""
        self.network = network

    def decided(self, decision):
        """Return a ColumnGeneration of the permitted legs, that goes on from here."""
        permitted = [decision.permits(r, k) for r, k in zip(self.columns.routes, self.columns.agents)]
        return self._part(permitted, network=decision.within(self.network), decisions=(*self.decisions, decision))

    def of_fleet(self, fleet):
        """Return a ColumnGeneration for another Fleet, that goes on from here."""
        return self._part([True] * len(self.columns.routes), fleet=fleet)

    def _part(self, kept, **changed):
        """Return a ColumnGeneration with the columns marked in kept (J,) and the attributes changed."""
        part = copy.copy(self)
        vars(part).update(
            changed,
            columns=dataclasses.replace(self.columns),
            best=None,
            dropped_at=np.inf,
            support=[],
            tried=list(self.tried),
        )
        part.columns.keep(kept)
        part._fresh_master()
        return part

    def elementary(self, least, most):
        """Return up to `most` routes of segments among the columns that repeat no target and make at least so many
        visits, those of least reduced cost at the best prices first."""
        columns, pi, least_cost = self.columns, self.best.pi, np.minimum(self.best.cheapest, 0.0)
        known = [j for j, r in enumerate(columns.routes) if least <= len(r) == len(np.unique(r))]
        known.sort(key=lambda j: columns.lengths[j] - pi[columns.routes[j]].sum() - least_cost[columns.agents[j]])
        return list(dict.fromkeys(columns.segments[j] for j in known))[:most]

    def cyclic(self, cheapest):
        """Return the routes whose cycles ng-sets ought to forbid: of the master's support, and with `cheapest` those of
        the best Evaluation as well: for one agent the bound rises only once nearly all cycles are gone."""
        routes = [route for route, _, _ in self.support]
        if cheapest:
            found, _ = self.best.columns(self.parameters.columns, self.parameters.columns_each, 3 * self.n)
            routes += [self.best.pieces.target[route] for route in found]
        return routes

    def grow(self, routes):
        """Let the ng-sets grow from the cycles in these routes; return whether they did."""
        if self.rolled_back:
            return False
        longest = min((_shortest_cycle(route) for route in routes), default=self.n)
        N = ngsets.grown(routes, self.N, max(longest, self.parameters.longest_cycle))
        if (N == self.N).all():
            return False
        self.N = N
        self.columns.keep([not ngsets.forbidden(route, N) for route in self.columns.routes])
        self._fresh_master()
        return True

    def roll_back(self):
        """Forget the cuts, and remember half as many targets as the largest ng-set does; return False if that is none.

        It is for good: ng-sets do not grow any more, and no cuts are added.
        """
        size = min(int(self.N.sum(axis=1).max()) // 2, self.parameters.ng_size)
        if size == 0:
            return False
        network, self.rolled_back = self.network, True
        self.N = ngsets.nearest(network.pieces, network.arcs, self.n, size)
        self.cuts, self.best, self.support = Cuts.none(self.n), None, []
        self._fresh_master()
        return True

    def add_cuts(self, rows, memory):
        self.cuts, self.best = self.cuts.with_more(rows, memory), None
        self._fresh_master()

    def evaluate(self, pi, cuts, few_entries=None, out=NO_LIMITS.out):
        """Return an Evaluation; of few entries it is of few arcs as well, and proves nothing. Unfinished is raised once
        out() tells that time is up, or entries are too many."""
        network, before = self.network if few_entries is None else self.near_network(), time.monotonic()
        limits = Limits(self.parameters.most_entries, out)
        found = evaluate(network, self.N, pi, cuts, self.fleet, self.tolerance, few_entries, limits)
        self.work += found.extensions
        if few_entries is None:
            self.lasted = time.monotonic() - before
        return found

    def late(self, clock):
        """Tell whether time is up, or there is too little of it for another evaluation."""
        return clock.out() or clock.seconds < self.lasted

    def near_network(self):
        """Return the present Network with only the arcs between targets that are close to each other, or itself where
        two would take too much memory."""
        if len(self.network.arcs.head) > self.parameters.most_arcs // 4:
            return self.network
        if self._near is None or self._near[0] is not self.network:
            pieces, arcs, starts, ends, *_ = self.network
            close = ngsets.nearest(pieces, arcs, self.n, self.parameters.few_targets)
            alive = (close | close.T)[pieces.target[arcs.tail], pieces.target[arcs.head]]
            near = self.network if alive.all() else restricted(self.network, alive, starts, ends)
            self._near = self.network, near
        return self._near[1]

    def evaluations(self, most, clock):
        """Return [Evaluation at the present prices] and up to `most` at other multipliers, as many as are cheap beside
        the work so far: those tried of the greatest L, each far from those before it, then such as are drawn around the
        present ones; fewer once time is up."""
        p, before = self.parameters, self.work
        first, chosen, size = self.evaluate(self.pi, self.cuts, None, clock.out), [self.pi], np.abs(self.pi).mean()
        most = min(most, int(p.prices_share * before / max(self.work - before, 1)))
        for _, pi in sorted(self.tried, key=lambda pair: -pair[0]):
            if len(chosen) <= most and min(np.abs(pi - other).mean() for other in chosen) >= p.apart * size:
                chosen.append(pi)
        drawn = np.random.default_rng(0).standard_normal((most + 1 - len(chosen), self.n))
        others = *chosen[1:], *(self.pi + p.drawn * size * drawn)
        found = [first]
        with contextlib.suppress(Unfinished):
            for pi in others:
                found.append(self.evaluate(pi, self.cuts, None, clock.out))
        return found

    def run(self, few_entries, limit, clock, on_bound):
        """Move the prices by evaluations of so many entries a piece, None for all, until the master agrees with them,
        the bound reaches the limit, or time is up; best is then an evaluation of all entries, unless time is up.

        Arcs that no solution below the limit uses are dropped on the way. on_bound: told each bound. Raises Unfinished
        as `evaluate` does.
        """
        self._converge(limit, clock, on_bound, few_entries)
        if few_entries is not None and not self.late(clock):
            self.best = self.evaluate(self.pi, self.cuts, None, clock.out)
            on_bound(self.best.bound)
            self._drop(limit)

    def _converge(self, limit, clock, on_bound, few_entries):
        """Move the prices until the master agrees with what evaluations of so many entries a piece find."""
        p = self.parameters
        pi, cuts, self.best = self.pi, self.cuts, None
        widest = p.box * max(np.abs(pi).mean(), 1e-3 * self.unit)
        box, thinnest, predicted, idle = min(2.0 * self.box, widest), 1e-4 * widest, np.inf, 0
        for _ in range(p.most_steps):
            evaluation = self._tried(pi, cuts, few_entries, clock.out)
            value, idle = evaluation.value, idle + 1
            self.tried.append((value, pi))
            on_bound(evaluation.bound)
            if self.best is None or value > self.best.value:  # the first is at the best prices known
                if self.best is not None and value > self.best.value + 0.3 * predicted:
                    box *= 1.5
                self.best, idle = evaluation, 0
            elif value < self.best.value - 2.0 * predicted:
                box *= 0.6
            if self.best.value >= limit or idle > p.idle_steps or self.late(clock):
                break
            routes, endless = evaluation.columns(p.columns, p.columns_each, 3 * self.n)
            pieces = evaluation.pieces
            if endless and self.grow([pieces.target[route] for route in endless]):
                continue
            # Values are tight near the best prices; far from them they may prove less of the same route.
            proving = [evaluation]
            if self.best is not evaluation and self.best.network is evaluation.network:
                proving.append(self.best)
            lengths = [max(own.length(route) for own in proving) for route in routes]
            segments = [tuple(int(i) for i in pieces.segment[route]) for route in routes]
            agents = [int(pieces.layer[route[0]]) for route in routes]
            self.offer([pieces.target[route] for route in routes], segments, agents, lengths)
            duals = self.master.solve(self.best.pi, box, clock.seconds)
            if duals is None:
                break
            if evaluation is not self.best and np.allclose(duals.pi, pi, atol=1e-9 * self.unit):
                box *= 0.4  # these columns prove more than L did, and cannot lead away from here
            predicted = duals.value - self.best.value
            used = np.flatnonzero(duals.level > 1e-6)
            self.support = [(self.columns.routes[j], duals.level[j], self.columns.agents[j]) for j in used]
            if predicted <= p.converged * max(limit - self.best.value, 0.0) + 1e-6 * self.unit:
                if duals.outside < 1e-6 or box < thinnest:
                    break
                box *= 4.0
            pi, cuts = duals.pi, self.cuts.with_prices(duals.sigma)
            if len(self.columns.routes) > p.most_columns:
                self._forget(duals.level)
            if evaluation is self.best and evaluation.complete:
                self._drop(limit)
        self.pi, self.cuts, self.box = self.best.pi, self.best.cuts, max(box, 10.0 * thinnest)

    def _drop(self, limit):
        """Drop the arcs that no solution below the limit uses, if the gap shrank much since the last time."""
        if limit - self.best.bound < self.parameters.dropped * self.dropped_at:
            self.dropped_at = limit - self.best.bound
            self.narrowed(self.best.eliminated(limit, self.tolerance))

    def _tried(self, pi, cuts, few_entries, out):
        """Return an Evaluation of so many entries; of fewer ones, if they tell already that it is no better."""
        p = self.parameters
        if few_entries is None and self.best is not None and p.few_entries:
            few = self.evaluate(pi, cuts, p.few_entries[-1], out)
            if few.value <= self.best.value:
                return few
        return self.evaluate(pi, cuts, few_entries, out)

    def _forget(self, level):
        """Keep the columns of the support and the latest ones."""
        keep = level > 1e-9
        keep[-self.parameters.most_columns // 2 :] = True
        self.columns.keep(keep)
        self.master.keep(keep)


def _shortest_cycle(route):
    last, least = {}, len(route)
    for k, u in enumerate(route):
        if u in last:
            least = min(least, k - last[u])
        last[u] = k
    return least
