"""The exact solver: bound, find, eliminate, enumerate, refine, until the gap is closed.

Every round works on pieces of the segments. (1) Multipliers raise the bound of the relaxed routes (`multipliers`). (2) A
beam of labels and a small set partitioning give tours, timed by the SOCP. (3) Pieces on no relaxed solution better than
the incumbent are dropped. (4) If few enough labels remain, all of them are grown and the set partitioning over their
routes gives a bound that holds for every solution. (5) Only pieces on routes still within the gap are kept, cut finer
around the incumbent's visit times, and the next round starts. Bounds are of second order in the pieces' lengths.
"""

import math
import time

import numpy as np

from ..backends.answer import Progress
from ..graph import build_graph
from ..tours import best_times, to_tour
from . import memory, pieces as pc
from .forest import Forest
from .multipliers import Relaxation, ascend
from .partition import choose

_FIRST_PIECES = 160
_MOST_LABELS = 25_000_000
_SAFETY = 1e-9


class Search:
    """One run of the exact solver on one instance; `run` leaves objective, bound, routes and status."""

    def __init__(self, instance, time_limit=None, gap=1e-4, progress=None):
        self.graph = build_graph(instance)
        self.n, self.m = instance.n_targets, min(instance.n_agents, instance.n_targets)
        self.gap, self.progress = gap, progress
        self.start = time.perf_counter()
        self.deadline = math.inf if time_limit is None else self.start + time_limit
        self.bound, self.objective, self.routes = 0.0, math.inf, None
        self.labels = 0
        self.timed = {}

    # -- state of the run

    def elapsed(self):
        return time.perf_counter() - self.start

    def out_of_time(self):
        return time.perf_counter() >= self.deadline

    def closed(self):
        return self.bound >= self.objective - self.gap * abs(self.objective)

    def raise_bound(self, bound):
        self.bound = min(max(self.bound, bound * (1.0 - _SAFETY)), self.objective)

    def limit(self):
        """Solutions at or above this value need not be looked at."""
        return self.objective * (1.0 - 0.5 * self.gap)

    def report(self, phase):
        if self.progress:
            objective = None if math.isinf(self.objective) else self.objective
            gap = None if objective is None else max(0.0, (objective - self.bound) / objective) if objective else 0.0
            self.progress(Progress(self.elapsed(), objective, self.bound, gap, self.labels, phase))

    # -- the rounds

    def run(self):
        width = sum(self.graph.t_hi[1:-1] - self.graph.t_lo[1:-1]) / _FIRST_PIECES
        self.cut = pc.even_cuts(self.graph, max(width, 1e-6 * self.graph.horizon))
        self.after = np.ones((self.n + 1, len(self.cut[0])), dtype=bool)
        self.before = np.ones((self.n, len(self.cut[0])), dtype=bool)
        self.width, self.pi, self.most = width, np.zeros(self.n), 300_000
        iterations = 60
        while not self.closed() and not self.out_of_time():
            self.round(iterations)
            iterations = 25

    def round(self, iterations):
        pieces = pc.make_pieces(self.graph, *self.cut)
        N = memory.neighbourhoods(pieces, self.n, 7)
        relaxation = Relaxation(pieces, self.n, self.m, N, memory.transitions(N), self.after, self.before)
        if math.isinf(self.objective):
            bound, self.pi = ascend(relaxation, self.pi, self.guess(relaxation), iterations // 2, self.out_of_time)
            if math.isinf(bound):
                self.bound = math.inf
                return
            self.raise_bound(bound)
            self.dive(relaxation, 1000)
        if self.objective < math.inf:
            bound, self.pi = ascend(relaxation, self.pi, self.objective, iterations, self.out_of_time)
            self.raise_bound(bound)
            self.report("multipliers")
            if self.closed(): return
            self.dive(relaxation, 1000)
        self.report("beam")
        relaxation.eliminate(self.pi, self.limit())
        self.report(f"eliminate {self.after.any(axis=0).sum()} -> {relaxation.after.any(axis=0).sum()} pieces")
        if self.out_of_time(): return
        done = self.enumerate(relaxation)
        if not done:
            self.after, self.before = relaxation.after, relaxation.before
            self.most = min(4 * self.most, _MOST_LABELS)
        self.refine(2.0 if not done else 3.0)

    def guess(self, relaxation):
        bound, _ = relaxation.evaluate(self.pi)
        return 1.3 * bound

    def dive(self, relaxation, beam):
        forest = Forest(relaxation, self.pi, self.limit(), np.inf, beam=beam, out_of_time=self.out_of_time)
        if forest.complete:
            self.improve(forest)

    def improve(self, forest, most=150):
        """Time the most promising routes exactly and choose among them."""
        order = np.argsort(forest.bound, kind="stable")
        columns, routes, costs, seen = [], [], [], set()
        if self.m > 1 and len(order) > most:
            _, chosen = choose(forest.members[:, order[:3000]], forest.cost[order[:3000]], self.m, time_limit=2.0)
            if chosen is not None:
                order = np.r_[order[chosen], order]
        for j in order:
            route = tuple(int(i) for i in forest.pieces.segment[forest.route(j)])
            if route in seen:
                continue
            seen.add(route)
            found = self.time(route)
            if found is not None:
                columns.append(j), routes.append(route), costs.append(found)
            if len(seen) >= most:
                break
        if not columns:
            return
        _, chosen = choose(forest.members[:, columns], np.array(costs), self.m)
        if chosen is not None:
            self.accept([routes[j] for j in chosen])

    def time(self, route):
        if route not in self.timed:
            found = best_times(self.graph, list(route))
            self.timed[route] = None if found is None else found[0]
        return self.timed[route]

    def accept(self, routes):
        objective = sum(self.time(route) for route in routes)
        if objective < self.objective:
            self.objective, self.routes = objective, routes

    def enumerate(self, relaxation):
        budget = np.inf
        if self.deadline < math.inf:
            budget = (self.deadline - time.perf_counter()) * 2e7
        forest = Forest(relaxation, self.pi, self.limit(), self.most, budget=budget, out_of_time=self.out_of_time)
        self.labels += forest.size
        if not forest.complete:
            self.report(f"too many labels {forest.size} of {self.most}")
            return False
        self.improve(forest)
        bound, chosen = choose(forest.members, forest.cost, self.m, self.limit()) if len(forest.cost) else (np.inf, None)
        if chosen is not None:
            routes = [tuple(int(i) for i in forest.pieces.segment[forest.route(j)]) for j in chosen]
            if all(self.time(r) is not None for r in routes): self.accept(routes)
        self.raise_bound(min(bound, self.limit_used(relaxation)))
        self.after, self.before = forest.used_pieces(self.limit())
        self.report(f"labels {[len(l.left) for l in forest.layers]} columns {len(forest.cost)} used {self.after.any(axis=0).sum()}")
        return True

    def limit_used(self, relaxation):
        return self.limit()

    def refine(self, factor):
        """Cut the pieces still alive into parts `factor` times shorter, the incumbent's visit times in the middle of theirs."""
        self.width /= factor
        segment, a, b = self.cut
        used = self.after.any(axis=0)
        centre = self.visit_times()
        rows, origin = [], []
        for q in np.flatnonzero(used):
            for start, end in _split(a[q], b[q], self.width, centre.get(segment[q])):
                rows.append((segment[q], start, end))
                origin.append(q)
        if not rows:
            self.raise_bound(self.limit())
            self.cut=None
            return
        self.cut = tuple(np.array(part) for part in zip(*rows))
        self.after, self.before = self.after[:, origin], self.before[:, origin]

    def visit_times(self):
        times = {}
        for route in self.routes or ():
            found = best_times(self.graph, list(route))
            times.update(zip(route, found[1]))
        return times


def _split(a, b, width, centre):
    """Return (start, end) pairs that cut [a, b] into parts of at most about `width`."""
    if centre is None or not a < centre < b:
        points = np.linspace(a, b, max(1, math.ceil((b - a) / width - 1e-9)) + 1)
    else:
        half = width / 2
        inner = np.arange(math.ceil((a - centre + half) / width), math.floor((b - centre + half) / width) + 1) * width
        inner = centre - half + inner
        points = np.r_[a, inner[(inner > a + 0.1 * width) & (inner < b - 0.1 * width)], b]
    return zip(points[:-1], points[1:])
