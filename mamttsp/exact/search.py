"""The search: bound, find, eliminate, enumerate, and a finer look at what is left, until the gap is closed.

See README.md for a round as a diagram.
"""

import numpy as np

from ..options import Progress
from ..timing import leg_lengths
from .column_generation import ColumnGeneration
from .cuts import MOST_CUTS, separate
from .enumeration import Enumeration
from .evaluation import first_network, refined, restricted
from .partition import relax_choice
from .pieces import even_cuts
from .settle import Sets, settle
from .standing import Standing


class Search:
    """A run of the exact solver for the targets of a graph; what it has found and proved is in `standing`.

    annealing: looks for tours before each round; start: routes of segments to begin with, or none.
    """

    def __init__(self, graph, fleet, gap, clock, parameters, annealing, progress=None, start=()):
        self.graph, self.n, self.fleet, self.m = graph, graph.n_targets, fleet, fleet.n_agents
        self.clock, self.parameters, self.progress, self.annealing = clock, parameters, progress, annealing
        self.standing = Standing(graph, fleet, gap)
        self.labels, self.columns, self.exhausted, self.enumerated, self.found = 0, 0, False, False, False
        self.unit, self.most_pieces = graph.size or 1.0, parameters.most_pieces
        self.means, self.first, self.fewer_arcs = 0, True, np.inf
        if start:
            self.incumbent.offer(start)

    @property
    def incumbent(self):
        return self.standing.incumbent

    def report(self, phase):
        if self.progress:
            self.progress(Progress(self.clock.spent, *self.standing.figures(), self.labels, phase, self.columns))

    def over(self):
        return self.standing.closed() or self.exhausted or self.clock.out()

    def near(self):
        """Tell whether the gap is small."""
        return self.standing.bound >= (1.0 - self.parameters.near) * self.standing.limit

    def run(self):
        """Run until the gap is closed, infeasibility is proved or time is up."""
        self.search_tours(self.parameters.annealing)
        self.width = self.first_width()
        network = first_network(self.graph, even_cuts(self.graph, self.graph.V_seg, self.width), range(self.n))
        self.generation = ColumnGeneration(
            network, self.n, self.fleet, self.first_prices(), self.parameters, self.unit
        )  # fmt: skip
        while not self.over():
            self.round()

    def first_width(self):
        """Return the length of the first pieces in s: a share of the time there is for each target, or of its windows
        in the mean if that is less, but no more pieces than a few."""
        graph, p = self.graph, self.parameters
        start, end = graph.t_lo[graph.V_seg], graph.t_hi[graph.V_seg]
        windows, of_targets = (end - start).sum(), self.n * graph.n_layers
        width = min(p.piece * (end.max() - start.min()) / self.n, windows / (of_targets * p.pieces_each))
        return max(width, windows / p.first_pieces, 1e-6 * graph.horizon)

    def first_prices(self):
        """Return (n,) half of the legs to and from each target in the incumbent, damped; even prices without one."""
        pi = np.full(self.n, self.unit / self.n)
        for route in self.incumbent.routes:
            _, times, _ = self.incumbent.timed(route)
            legs = leg_lengths(self.graph, route, times)
            pi[self.graph.tau[list(route)]] = 0.25 * (legs[:-1] + legs[1:])
        return pi

    def search_tours(self, looks):
        """Look for tours by ruin and recreate, so many looks for each target, then among all their routes."""
        looks, before = max(1, round(self.n * looks)), self.incumbent.objective
        for look in range(looks):
            if self.clock.out():
                break
            if routes := self.annealing.run(
                self.parameters.annealing_step, 1.0 - look / looks, 1.0 - (look + 1) / looks
            ):
                self.incumbent.offer(routes)
        self.recombine()
        self.found = self.incumbent.objective < before
        self.report("heuristic")

    def recombine(self):
        if self.m > 1 and not self.clock.out():
            self.incumbent.recombine(min(self.parameters.choice_seconds, self.clock.seconds))

    def round(self):
        """Raise the bound over the present pieces, drop what is beyond the limit, and try to enumerate the rest."""
        p, before, routes = self.parameters, self.standing.bound, None
        self.generation.offer_incumbent(self.incumbent)
        for most_entries in (*p.few_entries, None):
            routes = self.stage(most_entries)
            if routes or self.over():
                break
        if not routes and not self.over():
            if not self.near() and (self.first or self.found):
                self.search_tours(p.annealing_later)
            worthwhile = self.standing.bound - before >= p.worthwhile * (self.standing.limit - before)
            if self.over() or self.strengthen(worthwhile):
                return
            # Shorter pieces make more labels of the same routes: with a wide gap these are the fewest there will be.
            if self.m == 1:
                routes = self.enumerate(p.enumeration_last)
        if not self.over():
            self.refine(routes)

    def stage(self, most_entries):
        """Move the prices with so many entries of each piece, and eliminate; return all routes if they are few."""
        p, generation = self.parameters, self.generation
        generation.run(most_entries, self.standing.limit, self.clock, self.standing.raise_bound)
        self.report("prices")
        if self.over():
            return None
        if most_entries is not None:
            return self.enumerate(p.enumeration_early) if self.first and self.m == 1 else None
        self.time_columns()
        network = generation.best.eliminated(self.standing.limit, generation.tolerance)
        generation.narrowed(network)
        self.report("elimination")
        if self.clock.out() or len(network.arcs.head) > self.fewer_arcs:
            return None
        self.fewer_arcs = p.fewer_arcs * len(network.arcs.head)
        return self.enumerate(p.enumeration)

    def time_columns(self):
        """Time the elementary columns of least reduced cost, and choose among all routes known."""
        least = self.n if self.m == 1 else 1
        for segments in self.generation.elementary(least, self.parameters.timed * self.n):
            if self.clock.out():
                return
            self.incumbent.timed(segments)
        self.recombine()

    def strengthen(self, worthwhile):
        """Go on with the present means of raising the bound over these pieces, if it was worthwhile, or with the next
        one: larger ng-sets, subset-row cuts; return False if there is none left."""
        if not (worthwhile or self.first):  # the first round over new pieces says nothing of either
            self.means += 1
        self.first = False
        if self.means == 0 and self.generation.grow(self.generation.cyclic(self.m == 1)):
            return True
        if self.means <= 1 and self.m > 1 and self.add_cuts():
            self.means = 1
            return True
        return False

    def add_cuts(self):
        generation = self.generation
        room = MOST_CUTS - len(generation.cuts.rows)
        if room <= 0 or not generation.support:
            return False
        routes, level = zip(*generation.support)
        rows, memory = separate(routes, level, self.n, min(room, self.parameters.cuts), self.parameters.violation)
        if not len(rows):
            return False
        generation.add_cuts(rows, memory)
        return True

    def enumerate(self, effort):
        """Enumerate all routes of solutions within the limit, extending `effort` labels for each entry that prices
        have extended; return them if that was enough, None else."""
        p, limit = self.parameters, self.standing.limit
        evaluation = self.generation.evaluate(self.generation.pi, self.generation.cuts)
        self.standing.raise_bound(evaluation.bound)
        slack = self.generation.best.slack(limit)
        routes = Enumeration(
            evaluation, slack, self.n, self.m == 1, p.most_labels, effort * self.generation.work, p.rate, self.clock
        )  # fmt: skip
        self.labels += routes.size
        if not routes.complete:
            self.report("labels")
            return None
        self.columns += len(routes.cost)
        sets = Sets(routes.visited, routes.agents, routes.cost, self.n)
        relaxed = relax_choice(sets.members, sets.agents, sets.cost, self.fleet, limit, self.unit, self.clock.seconds)
        if relaxed is None:
            return None
        self.standing.raise_bound(min(relaxed.bound, limit))
        self.report("routes")
        alive = relaxed.slack[sets.of_column] >= routes.cost - sets.cost[sets.of_column]
        self.time_routes(routes, np.flatnonzero(alive))
        routes.lead(alive)
        sets.keep(relaxed.slack >= 0.0)
        # Far from the limit, shorter pieces raise all bounds at once; but that is tried only once.
        ready = self.m == 1 or self.enumerated or self.near()
        self.enumerated = True
        if not self.over() and ready and 0 < len(sets.cost) <= self.parameters.few_sets:
            self.settle(sets, routes)
        return routes

    def time_routes(self, routes, columns):
        """Time the columns of least reduced cost, and choose among all routes known."""
        order = columns[np.argsort(-routes.spare[columns], kind="stable")]
        for column in order[: self.parameters.timed * self.n]:
            if self.clock.out():
                return
            route = routes.segments(column)
            if self.incumbent.timed(route) and self.m == 1:
                self.incumbent.offer([route])
        self.recombine()

    def settle(self, sets, routes):
        """Settle the competing sets of targets by timing their sequences."""

        def settle_set(columns):
            sequences = routes.sequences(columns, self.parameters.few_sequences)
            if sequences is None:
                return None
            found = []
            for route in sequences:
                if self.clock.out():
                    return None
                if timed := self.incumbent.timed(route):
                    found.append(timed[2])
                    if self.m == 1:
                        self.incumbent.offer([route])
            return min(found, default=np.inf)

        def on_bound(bound):
            self.standing.raise_bound(bound)
            self.recombine()
            self.report("settle")

        done = settle(
            sets, self.fleet, lambda: self.standing.limit, self.unit, settle_set, on_bound, self.clock
        )  # fmt: skip
        self.recombine()
        self.exhausted = done and not self.standing.closed()

    def refine(self, routes=None):
        """Cut what is left into shorter pieces, with the incumbent's visit times in the middle of theirs."""
        p, network = self.parameters, self.generation.network
        if routes is not None:
            used = routes.used_arcs(network.arcs)
            network = restricted(network, used, *routes.used_ends())
        before, self.width = self.width, self.width / (p.finer_after_routes if routes is not None else p.finer)
        if self.width < p.thinnest * self.graph.horizon:  # thinner pieces drown in rounding errors
            self.exhausted = True
            return
        if not len(network.starts):  # nothing is left below the limit
            self.standing.raise_bound(self.standing.limit)
            return
        length = (network.pieces.b - network.pieces.a).sum()
        shortest = length / max(self.most_pieces - len(network.starts), 1)
        if shortest > 0.9 * before:  # there is no room for shorter pieces: make some
            self.most_pieces *= 2
            shortest = length / max(self.most_pieces - len(network.starts), 1)
        self.width = max(self.width, shortest)
        if len(network.arcs.head) * (before / self.width) ** 2 > p.most_arcs:  # no memory for that
            self.exhausted = True
            return
        network = refined(network, self.graph, self.width, self.incumbent.visit_times(), range(self.n))
        self.generation.moved(network)
        self.means, self.first, self.fewer_arcs = 0, True, np.inf
