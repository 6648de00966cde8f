"""A node of the search: some of the solutions, over pieces and arcs of its own. A round bounds, finds, eliminates and
enumerates; what is left is cut finer or split.

See README.md for a round as a diagram.
"""

import copy

import numpy as np

from . import splitting
from .cuts import MOST_CUTS, separate
from .enumeration import Enumeration
from .evaluation import refined, restricted
from .ngroutes import Unfinished
from .partition import relax_choice
from .settle import Sets, settle


class Node:
    """Solutions over the network of `generation`, of no more routes than its fleet has.

    search: the run, with what it knows of tours; bound: lower bound on the solutions of the node that are below the
    limit; priced: the part of it that prices prove; exhausted: nothing can raise that any more; width: length of the
    pieces in s.
    """

    def __init__(self, search, generation, width):
        self.search, self.generation, self.width = search, generation, width
        self.n, self.parameters, self.clock = search.n, search.parameters, search.clock
        self.incumbent, self.bound, self.exhausted, self.enumerated = search.incumbent, 0.0, False, False
        self.most_pieces, self.means, self.first, self.enumerated_at = search.parameters.most_pieces, 0, True, np.inf
        self.finer_from, self.splits, self.few_sequences = -np.inf, False, search.parameters.few_sequences
        self.priced = 0.0

    @property
    def limit(self):
        return self.search.limit

    @property
    def m(self):
        """How many routes there are at most."""
        return self.generation.fleet.n_agents

    @property
    def alone(self):
        """Whether one route serves all targets."""
        return self.m == 1

    def raise_bound(self, bound):
        self.bound = max(self.bound, min(bound, self.limit))
        self.search.raise_bound()

    def raise_priced(self, bound):
        self.priced = max(self.priced, min(bound, self.limit))
        self.raise_bound(bound)

    def evaluated(self, bound):
        """Take the bound of an evaluation, and look for tours again while the gap is wide, if that has become cheap."""
        self.raise_priced(bound)
        if not self.over() and not self.near(self.limit):
            self.search.search_more_tours(self.generation.work)

    def over(self):
        return self.search.over() or self.exhausted or self.bound >= self.limit

    def near(self, limit):
        """Tell whether the gap between the bound and `limit` is small."""
        return self.bound >= (1.0 - self.parameters.near) * limit

    def round(self):
        """Raise the bound over the present pieces, drop what is beyond the limit, and try to enumerate the rest; return
        the nodes to go on with."""
        try:
            return self.raised()
        except Unfinished:
            self.exhausted = not (self.clock.out() or self.generation.roll_back())
            return [self]

    def raised(self):
        """The round itself, unless its values to go take more entries or time than there may be: then Unfinished."""
        p, before, routes = self.parameters, self.priced, None
        self.generation.offer_incumbent(self.incumbent)
        few_entries = p.few_entries if self.finer_from == -np.inf else ()  # prices are good once pieces were refined
        for most_entries in (*few_entries, None):
            routes = self.stage(most_entries)
            if routes or self.over():
                break
        if self.over() or (not routes and self.strengthen(self.worthwhile(before))):
            return [self]
        self.splits = self.splits or not self.worthwhile(self.finer_from)
        if (routes or not self.splits) and self.refine(routes):
            return [self]
        if parts := self.split():
            return parts
        self.exhausted = not self.refine(routes)
        return [self]

    def worthwhile(self, before):
        """Tell whether prices closed much of the gap since they proved `before`."""
        return self.priced - before >= self.parameters.worthwhile * (self.limit - before)

    def split(self):
        """Return parts that hold all solutions of the node; none if the prices do not tell on what to split."""
        generation, p = self.generation, self.parameters
        fleets = splitting.fleets(generation.support, generation.fleet, p.whole_routes)
        parts = [generation.of_fleet(fleet) for fleet in fleets]
        if not parts:
            parts = [generation.decided(decision) for decision in splitting.decisions(generation.support, p.whole)]
        return [self.part(generation) for generation in parts]

    def part(self, generation):
        """Return a Node with a part of this one's solutions, which goes on from here."""
        part = copy.copy(self)
        part.generation, part.means, part.first, part.enumerated_at = generation, 0, False, np.inf
        return part

    def stage(self, most_entries):
        """Move the prices with so many entries of each piece, and eliminate; return all routes if they are few."""
        generation = self.generation
        generation.run(most_entries, self.limit, self.clock, self.evaluated)
        self.search.report("prices")
        if self.over():
            return None
        if most_entries is not None:
            return self.enumerate(self.parameters.early_work) if self.first and self.alone else None
        self.time_columns()
        network = generation.best.eliminated(self.limit, generation.tolerance)
        generation.narrowed(network)
        self.search.report("elimination")
        return self.enumerate()

    def time_columns(self):
        """Time the elementary columns of least reduced cost, and choose among all routes known."""
        least = self.n if self.alone else 1
        for segments in self.generation.elementary(least, self.parameters.timed * self.n):
            if self.clock.out():
                return
            self.incumbent.timed(segments)
        self.search.recombine()

    def strengthen(self, worthwhile):
        """Go on with the present means of raising the bound over these pieces, if it was worthwhile, or with the next
        one: larger ng-sets, subset-row cuts; return False if there is none left."""
        if not (worthwhile or self.first):  # the first round over new pieces says nothing of either
            self.means += 1
        self.first = False
        if self.means == 0 and self.generation.grow(self.generation.cyclic(self.alone)):
            return True
        if self.means <= 1 and self.m > 1 and self.add_cuts():
            self.means = 1
            return True
        return False

    def add_cuts(self):
        generation = self.generation
        room = 0 if generation.rolled_back else MOST_CUTS - len(generation.cuts.rows)
        if room <= 0 or not generation.support:
            return False
        routes, level, _ = zip(*generation.support)
        rows, memory = separate(routes, level, self.n, min(room, self.parameters.cuts), self.parameters.violation)
        if not len(rows):
            return False
        generation.add_cuts(rows, memory)
        return True

    def enumerate(self, work=1.0):
        """Enumerate all routes of solutions within the limit; return them, or None if there is no room for all labels,
        or there was none and the gap has hardly shrunk since; work: see `competing`."""
        p, alone = self.parameters, self.alone
        if self.clock.out() or self.limit - self.priced > p.narrower * self.enumerated_at:
            return None
        self.enumerated_at = self.limit - self.priced
        evaluations = self.generation.evaluations(p.prices if alone else 0, self.clock)
        self.raise_priced(evaluations[0].bound)
        if (found := self.competing(evaluations, self.limit, work)) is None:
            self.search.report("labels")
            self.search.search_more_tours(self.generation.work)
            self.look_lower(evaluations)
            return None
        routes, sets = found
        # Far from the limit, shorter pieces raise all bounds at once; but that is tried only once.
        ready = alone or self.enumerated or self.near(self.limit)
        self.enumerated = True
        if ready and self.settle(sets, routes, self.limit):
            self.exhausted = not self.over()
        return routes

    def look_lower(self, evaluations):
        """Enumerate all routes of solutions in a lower part of what lies between the bound and the limit, the greatest
        one for which there is room: they raise the bound as far, or lead to tours."""
        bound, gap, finer_gain = self.bound, self.limit - self.bound, self.priced - self.finer_from
        for part in self.parameters.parts:
            limit = bound + part * gap
            if self.over() or limit - self.priced < finer_gain:  # shorter pieces will raise it further
                return
            if found := self.competing(evaluations, limit, self.parameters.parts_work):
                routes, sets = found
                if self.near(limit):
                    self.settle(sets, routes, limit)
                return

    def competing(self, evaluations, limit, work=1.0):
        """Enumerate all routes of solutions within `limit`, raise the bound by the choice among them, and look for
        tours; return (Enumeration, Sets) of what competes, or None without room or time; work: share of what an
        enumeration may take."""
        p, alone = self.parameters, self.alone
        share = p.enumeration_alone if alone else p.enumeration
        budget = work * max(share * self.generation.work, p.least_extensions)
        longest = max(map(len, self.incumbent.routes), default=self.n)
        most = p.most_labels_alone - self.search.arcs // 2 if alone else p.most_labels
        routes = Enumeration(evaluations, limit, alone, longest, most, budget, self.clock)
        self.search.labels += routes.size
        if not routes.complete:
            return None
        self.search.columns += len(routes.cost)
        sets = Sets(routes.visited, routes.agents, routes.cost, self.n)
        relaxed = relax_choice(
            sets.members, sets.agents, sets.cost, self.generation.fleet, limit, self.search.unit, p, self.clock.seconds
        )
        if relaxed is None:
            return None
        self.raise_bound(min(relaxed.bound, limit))
        self.search.report("routes")
        room = relaxed.slack[sets.of_column] - (routes.cost - sets.cost[sets.of_column])
        self.time_routes(routes, room)
        routes.lead(room >= 0.0)
        sets.keep(relaxed.slack >= 0.0)
        return routes, sets

    def time_routes(self, routes, room):
        """Time the columns that the linear relaxation takes or would take first, and choose among all routes known;
        room: (J,) by how much the cost of each may grow, negative for those that no choice within the limit takes."""
        order = np.argsort(-room, kind="stable")[: self.parameters.timed * self.n]
        for column in order[room[order] >= 0.0]:
            if self.clock.out():
                return
            route = routes.segments(column)
            if self.incumbent.timed(route) and self.alone:
                self.incumbent.offer([route])
        self.search.recombine()

    def settle(self, sets, routes, limit):
        """Settle the competing sets of targets, those of all solutions within `limit`, by timing their sequences;
        return whether nothing of them is left to do."""
        if self.over() or not 0 < len(sets.cost) <= self.parameters.few_sets:
            return False
        shortest = {}  # of a set, by its first column: the route

        def settle_set(columns):
            sequences, best = routes.sequences(columns, int(self.few_sequences)), np.inf
            if sequences is None:
                return None
            for route in sequences:
                if self.clock.out():
                    return None
                if (timed := self.incumbent.timed(route)) is None:
                    continue
                if self.alone:
                    self.incumbent.offer([route])
                if timed[2] < best:
                    best, shortest[columns[0]] = timed[2], route
            return best

        def on_bound(bound):
            self.raise_bound(bound)
            self.search.recombine()
            self.search.report("settle")

        done, chosen = settle(
            sets, self.generation.fleet, lambda: min(limit, self.limit), self.search.unit, self.parameters, settle_set,
            on_bound, self.clock,
        )  # fmt: skip
        if chosen:
            self.incumbent.offer([shortest[columns[0]] for columns in chosen])
        self.search.recombine()
        self.few_sequences *= self.parameters.more_sequences  # shorter pieces take longer, and leave fewer sequences
        return done

    def refine(self, routes=None):
        """Cut what is left into shorter pieces, with the incumbent's visit times in the middle of theirs; return False
        if there is no room for that."""
        p, graph, network = self.parameters, self.search.graph, self.generation.network
        if routes is not None:
            used = routes.used_arcs(network.arcs)
            network = restricted(network, used, *routes.used_ends())
        if not len(network.starts):  # nothing is left below the limit
            self.raise_bound(self.limit)
            return True
        width = self.width / (p.finer_after_routes if routes is not None else p.finer)
        if width < p.thinnest * graph.horizon:  # thinner pieces drown in rounding errors
            return False
        room = max(min(p.most_arcs, p.arcs_rate * self.clock.seconds), 1.0)  # time may be up
        width = max(width, self.shortest(network), self.width * np.sqrt(len(network.arcs.head) / room))
        if width > p.hardly * self.width:  # no memory, or no time, for much shorter ones
            return False
        network = refined(network, graph, width, self.incumbent.visit_times(), range(self.n))
        self.generation.moved(network)
        self.width, self.means, self.first, self.enumerated_at, self.finer_from = width, 0, True, np.inf, self.priced
        return True

    def shortest(self, network):
        """Return the length of pieces of which there may be as many as there is room for, after making some if these
        would hardly be shorter."""
        length, used = (network.pieces.b - network.pieces.a).sum(), len(network.starts)
        while (shortest := length / max(self.most_pieces - used, 1)) > self.parameters.hardly * self.width:
            self.most_pieces *= 2
        return shortest
