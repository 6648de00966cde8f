"""Branch and bound for the MICP over Clarabel's relaxations: small, exact, with a proved bound at any stop."""

import heapq
import itertools
import math
import time

import numpy as np

from ..options import Progress
from ..solution import known_length, relative_gap
from .best_found import BestFound
from .branching import branch
from .loads import load_limits
from .perspective import Perspective
from .propagation import propagate
from .pseudo_costs import FLOWN, NOT_FLOWN, PseudoCosts
from .separation import violated_sets

#: relative gap below which relaxations and best times are too inexact to tell lengths apart
LEAST_GAP = 1e-6


class TreeSearch:
    """Best bound first, with dives along the child in which the branching edge is flown.

    A node is the set of edges left to it: branching on an edge takes away either its rivals or the edge itself.
    """

    def __init__(self, formulation, options):
        self.start = time.perf_counter()
        self.options, self.graph, self.counts = options, formulation.graph, formulation.counts
        self.relaxation = Perspective(formulation.conic_program().relaxed(), self.graph, self.counts, options.threads)
        self.alone = self.counts.sum() == 1
        self.costs = PseudoCosts(self.graph)
        self.heap, self.order = [], itertools.count()
        self.current = 0.0  # bound of the node at hand; 0 is a bound of every length
        self.closed = math.inf  # least bound at which something was given up for being no better than the incumbent
        self.best = BestFound(self.graph, self.counts)
        if options.start:
            self.best.begin_from(options.start)
        self.nodes = self.cuts = 0

    @property
    def cutoff(self):
        """What is at least this long is not worth looking for."""
        return self.best.length * (1.0 - max(self.options.gap, LEAST_GAP))

    @property
    def bound(self):
        """A lower bound on every set of tours, at any time."""
        return min(self.best.length, self.closed, self.current, *(node[0] for node in self.heap[:1]))

    @property
    def spent(self):
        """Seconds since the start."""
        return time.perf_counter() - self.start

    def run(self):
        """Search until the gap is proved; return False if the time limit came first."""
        least, most = load_limits(self.graph)
        self._push(0.0, least <= most)
        while self.heap and self.heap[0][0] < self.cutoff:
            self.current = self.heap[0][0]  # before the node is taken off, so that `bound` holds at any moment
            bound, _, alive, branched = heapq.heappop(self.heap)
            if not self._dive(bound, alive, branched):
                return False
            self.current = math.inf
        return True

    def _push(self, bound, alive, branched=None):
        heapq.heappush(self.heap, (bound, next(self.order), alive, branched))

    def _dive(self, bound, alive, branched):
        """Follow one branch down until nothing better is left in it; return False if time ran out.

        branched: (side, pair, flow) of the branching that made the node, None if it was on no pair.
        """
        while self._time_left() > 0:
            found = self._process(bound, alive)
            self._report()
            self._learn(branched, bound, found)
            if found is None:
                return True
            bound, alive, y = found
            self.current = bound
            if self._time_left() <= 0:  # cuts may be missing, so that y is no flow to branch on
                break
            children = branch(self.graph, y, alive, self.costs)
            if children is None:
                self._finish(alive)
                return True
            alive = children.flown
            sides = (FLOWN, NOT_FLOWN) if children.pair is not None else ()
            branched, beside = [(side, children.pair, children.flow) for side in sides] or (None, None)
            self._push(bound, children.other, beside)
        return False

    def _learn(self, branched, before, found):
        """Note by how much a branching raised the bound; a node with nothing better left has reached the cutoff."""
        after = self.cutoff if found is None else found[0]
        if branched is not None and not math.isinf(after):
            self.costs.learn(*branched, max(after - before, 0.0))

    def _process(self, bound, alive):
        """Return (bound, alive, y) of a node with less left to it, or None if nothing better than the incumbent is."""
        while True:
            possible = propagate(self.graph, alive, self.alone)
            if possible is None:
                return None
            alive, times = possible
            relaxed = self.relaxation.relax(alive, times, self._time_left())
            self.nodes += 1
            bound = max(bound, relaxed.bound)
            if bound >= self.cutoff:
                self.closed = min(self.closed, bound)
                return None
            # Worth less than a relaxation more: the children are the first to keep to it.
            self.relaxation.successions.demand(relaxed.y, alive, times)
            if not self._cut_subtours(relaxed.y) or self._time_left() <= 0:
                break
        if self.best.flow is None and self._time_left() > 0:
            self.best.along(relaxed.extra, alive, times)
        self.best.near(relaxed.y, alive)
        return bound, self._without_dear_edges(bound, alive, relaxed.extra), relaxed.y

    def _finish(self, alive):
        """Try the one choice of edges that a node has left."""
        if (possible := propagate(self.graph, alive, self.alone)) is not None:
            self.best.on(possible[0])

    def _cut_subtours(self, y):
        """Cut off the sets of targets that the flow y enters less than once; tell whether there were any."""
        sets = violated_sets(self.graph, y)
        inside = [np.isin(self.graph.tau[self.graph.edges], S).all(axis=1) for S in sets]
        if sets:
            self.relaxation.add_cuts([(np.flatnonzero(edges), len(S) - 1) for S, edges in zip(sets, inside)])
            self.cuts += len(sets)
        return bool(sets)

    def _without_dear_edges(self, bound, alive, extra):
        """Take away the edges that no solution better than the incumbent can fly."""
        dear = alive & (bound + extra >= self.cutoff)
        if dear.any():
            self.closed = min(self.closed, (bound + extra)[dear].min())
        return alive & ~dear

    def _time_left(self):
        limit = self.options.time_limit
        return math.inf if limit is None else limit - self.spent

    def _report(self):
        if self.options.progress is None and not self.options.verbose:
            return
        length, bound = known_length(self.best.length), known_length(self.bound)
        step = Progress(self.spent, length, bound, relative_gap(length, bound), self.nodes, "search")
        if self.options.verbose:
            print(step)
        if self.options.progress is not None:
            self.options.progress(step)
