"""The search: rounds of bounding, finding, eliminating, enumerating and refining, until the gap is closed.

Every round works on pieces of the segments. (1) Multipliers raise the bound of the relaxed routes (`multipliers`).
(2) A beam of labels gives routes, timed by the SOCP. (3) Pieces on no relaxed solution better than the incumbent are
dropped. (4) If few enough labels remain, all of them are grown, and the set partitioning over their routes bounds every
solution. (5) Only pieces on routes still within the gap are kept, cut finer around the incumbent's visit times, and the
next round starts; with several agents, the sets of targets that compete are settled one by one instead (`settle`).
All bounds are of second order in the lengths of the pieces. A light round comes first, which spends little on (1), and
goes on to (4) without (2): where windows are short it suffices.
"""

import math

import numpy as np

from ..options import Progress
from . import memory
from .forest import Forest
from .multipliers import Relaxation, ascend
from .partition import relax_choice
from .pieces import even_cuts, make_pieces
from .refine import finer
from .settle import Sets, settle
from .standing import Standing

_PIECES = 150
#: targets that a relaxed route remembers, and iterations of column generation in the first round
_MEMORY, _ASCENT = 7, 15
#: the same in light rounds, and for so few targets: their labels are few, however weak the bound
_SMALL, _LIGHT_MEMORY, _LIGHT_ASCENT = 10, 4, 5
#: iterations from good multipliers
_FEW_MORE = 10
#: more targets need more iterations than these, by so many for each further target: at first, and later
_MEDIUM, _MORE_AT_FIRST, _MORE = 20, 2, 1
_BEAM = 1000
_LIGHT_LABELS, _FEW_LABELS, _MOST_LABELS = 100_000, 500_000, 8_000_000
#: iterations of ruin and recreate between two looks at the clock, and how many looks: n^2 over a number that is smaller
#: after a first round that did not suffice
_STEP, _QUICK, _LONG = 500, 60, 20
_FEW_SETS = 2500
#: of segments that are timed one by one: in a light round, and in each other as many more, for targets that meet leave
#: ties for ever
_LIGHT_SEQUENCES, _FEW_SEQUENCES = 50, 1500
#: pieces that a round may have: the table of their legs grows with the square
_MOST_PIECES = 2000
#: least length of a piece, as a share of the horizon
_THINNEST = 1e-8
#: label extensions per second, an underestimate, to stop in time
_RATE = 6e7


class Search:
    """A run of the exact solver for some targets of a graph; what it has found and proved is in `standing`.

    cutoff: as in Standing; annealing: looks for tours before each round, until a round has enumerated all labels; None
    does without.
    """

    def __init__(self, graph, targets, n_agents, gap, clock, progress=None, cutoff=math.inf, annealing=None):
        self.graph, self.targets, self.n, self.m = graph, list(targets), len(targets), min(n_agents, len(targets))
        self.gap, self.clock, self.progress, self.annealing = gap, clock, progress, annealing
        self.standing = Standing(graph, self.m, gap, cutoff)
        self.labels, self.columns, self.rounds, self.exhausted = 0, 0, 0, False
        self.pi, self.most = np.zeros(self.n), _FEW_LABELS
        self.enumerated = False
        beyond = max(self.n - _MEDIUM, 0)
        self.few_more = _FEW_MORE + _MORE * beyond
        self.memory, self.ascent = _MEMORY, _ASCENT + _MORE_AT_FIRST * beyond
        if self.n <= _SMALL:
            self.memory, self.ascent = _LIGHT_MEMORY, _LIGHT_ASCENT
        windows = sum(self.graph.t_hi[i] - self.graph.t_lo[i] for i in self._segments())
        self.width = max(windows / _PIECES, 1e-6 * graph.horizon)
        self.start_from(*even_cuts(graph, self._segments(), self.width))

    def _segments(self):
        return [int(i) for u in self.targets for i in self.graph.C(u)]

    def start_from(self, segment, a, b):
        """Let the first round work on these pieces."""
        self.cut = segment, a, b
        self.after = np.ones((self.n + 1, len(a)), dtype=bool)
        self.before = np.ones((self.n, len(a)), dtype=bool)

    @property
    def incumbent(self):
        return self.standing.incumbent

    def report(self, phase):
        if self.progress:
            figures = self.standing.figures()
            self.progress(Progress(self.clock.spent, *figures, self.labels, phase, self.columns))

    def over(self):
        return self.standing.closed() or self.exhausted or self.clock.out()

    def run(self):
        """Run rounds until the gap is closed, infeasibility is proved (bound infinite) or time is up."""
        if self.annealing and self.n > _SMALL:
            self.light_round()
        while not self.over():
            self.round()
            self.ascent = min(self.ascent, self.few_more)

    def light_round(self):
        """A round of little effort; if that is too little, it still leaves tours, a bound and multipliers."""
        self.search_tours(1)
        relaxation = self.relax(_LIGHT_MEMORY, _LIGHT_ASCENT)
        if not self.over():
            self.enumerate(relaxation, _LIGHT_LABELS)
        if self.enumerated and not self.over():
            self.refine()

    def round(self):
        self.rounds += 1
        if self.annealing and not self.enumerated:
            self.search_tours(max(1, self.n**2 // (_QUICK if self.rounds == 1 else _LONG)))
        relaxation = self.relax(self.memory, self.ascent)
        if self.over():
            return
        if not self.enumerated and self.n > _SMALL:
            self.dive(relaxation)
        self.enumerate(relaxation, self.most)
        if not self.enumerated:
            self.most = min(4 * self.most, _MOST_LABELS)
        if not self.over():
            self.refine()

    def search_tours(self, looks):
        """Look for tours by ruin and recreate, in steps short enough to end in time, then among all their routes."""
        for look in range(looks):
            if self.clock.out():
                break
            if routes := self.annealing.run(_STEP, 1.0 - look / looks, 1.0 - (look + 1) / looks):
                self.incumbent.offer(routes)
        self.incumbent.recombine(self.targets)
        self.report("heuristic")

    def relax(self, remembered, iterations):
        """Return the relaxed routes over the pieces, evaluated at the best multipliers found, whose bound is taken."""
        pieces = make_pieces(self.graph, *self.cut, self.targets)
        N = memory.neighbourhoods(pieces, self.n, remembered)
        relaxation = Relaxation(pieces, self.n, self.m, N, memory.transitions(N), self.after, self.before)
        known = self.incumbent.columns(self.targets, self.standing.cutoff)
        bound, self.pi = ascend(relaxation, self.pi, known, iterations, self.clock.out)
        self.standing.raise_bound(bound)
        self.report("multipliers")
        return relaxation

    def dive(self, relaxation):
        """Look for tours among the routes of a beam of labels."""
        forest = Forest(relaxation, self.pi, self.standing.limit, np.inf, beam=_BEAM, out_of_time=self.clock.out)
        if forest.complete and len(forest.cost):
            self.incumbent.improve(forest, np.arange(len(forest.cost)))
        self.report("beam")

    def enumerate(self, relaxation, most):
        """Drop what is on no relaxed solution within the limit; if no more than `most` labels are, grow them all and
        bound every solution by the choice among their routes."""
        relaxation.eliminate(self.pi, self.standing.limit)
        if self.clock.out():
            return
        self.after, self.before = relaxation.after, relaxation.before
        budget = self.clock.seconds * _RATE
        forest = Forest(relaxation, self.pi, self.standing.limit, most, budget=budget, out_of_time=self.clock.out)
        self.labels += forest.size
        self.enumerated = forest.complete
        if not forest.complete:
            self.report("labels")
            return
        self.columns += len(forest.cost)
        sets = Sets(forest.visited, forest.cost, self.n)
        relaxed = relax_choice(sets.members, sets.cost, self.m, self.standing.limit)
        self.standing.raise_bound(min(relaxed.bound, self.standing.limit))
        alive = relaxed.slack[sets.of_column] >= forest.cost - sets.cost[sets.of_column]
        if alive.any():
            self.incumbent.improve(forest, np.flatnonzero(alive))
            self.pi = relaxed.dual if self.m > 1 else self.pi
        leads = forest.leading(alive)
        self.after, self.before = forest.used_pieces(leads)
        self.report("routes")
        if self.m == 1 and not self.over():
            self.finish(forest, leads)
        elif not self.over():
            sets.keep(relaxed.slack >= 0.0)
            if len(sets.cost) <= _FEW_SETS:
                self.settle(sets)

    def finish(self, forest, leads):
        """With one agent: if few sequences of segments are left, time them all; nothing else is below the limit."""
        sequences = forest.sequences(leads, _LIGHT_SEQUENCES + self.rounds * _FEW_SEQUENCES)
        if sequences is None:
            return
        bounds = [self.standing.limit]
        for route in sequences:
            self.incumbent.offer([route])
            if found := self.incumbent.timed(route):
                bounds.append(found[2])
        self.standing.raise_bound(min(bounds))
        self.exhausted = True  # what is left of the gap is the accuracy of the time SOCPs
        self.report("sequences")

    def settle(self, sets):
        """Settle the competing sets of targets, each with one agent as a small instance of its own."""
        self.known = {}
        settle(sets, self.m, lambda: self.standing.limit, self.solve_set, self.settled, self.clock.out)

    def settled(self, bound):
        """Take a bound of the settling, and the best choice among the routes that it has found."""
        self.standing.raise_bound(bound)
        if self.known:
            self.incumbent.offer_choice(list(self.known.values()), self.targets)
        self.report("settle")

    def solve_set(self, targets, cutoff, dual):
        """Return a lower bound on one agent's cheapest route through a set of targets, exact if it is below the
        cutoff."""
        used = self.after.any(axis=0)
        segment, a, b = (part[used] for part in self.cut)
        mine = [self.targets[u] for u in targets]
        part = np.isin(self.graph.tau[segment], mine)
        search = Search(self.graph, mine, 1, 0.1 * self.gap, self.clock, cutoff=cutoff)
        search.start_from(segment[part], a[part], b[part])
        search.width, search.pi = self.width, dual[list(targets)]
        search.ascent = 1 if len(mine) <= _SMALL else search.few_more
        search.run()
        self.labels, self.columns = self.labels + search.labels, self.columns + search.columns
        if search.incumbent.routes:
            self.known[targets] = search.incumbent.routes[0]
        return search.standing.bound

    def refine(self):
        """Cut the pieces still in use into shorter parts, with the incumbent's visit times in the middle of theirs."""
        self.width /= 3.0 if self.enumerated else 2.0
        if self.width < _THINNEST * self.graph.horizon:  # thinner pieces drown in rounding errors
            self.exhausted = True
            return
        _, a, b = self.cut
        used = self.after.any(axis=0)
        if not used.any():  # nothing is left below the limit
            self.standing.raise_bound(self.standing.limit)
            return
        self.width = max(self.width, (b - a)[used].sum() / max(_MOST_PIECES - used.sum(), 1))
        self.cut, origin = finer(self.cut, np.flatnonzero(used), self.width, self.incumbent.visit_times())
        self.after, self.before = (np.take(alive, origin, axis=1) for alive in (self.after, self.before))
