"""Branch and bound for the MICP over Clarabel's relaxations: small, exact, with a proved bound at any stop."""

import heapq
import itertools
import math
import time

import clarabel
import numpy as np

from ..instance import InputError
from ..solution import FEASIBLE, INFEASIBLE, OPTIMAL, UNKNOWN, relative_gap
from ..subtours import read_flow
from ..tours import best_tours
from .answer import Answer, Progress
from .branching import branch
from .conic import conic_program
from .perspective import Perspective
from .propagation import propagate
from .rounding import round_flow
from .separation import violated_sets

#: relative gap below which relaxations and best times are too inexact to tell lengths apart
LEAST_GAP = 1e-6


def solve(formulation, options):
    """Solve a MICP of either modeler and return the Answer, its incumbent made of tours that can be flown.

    Cycles that miss the depot are cut off as they turn up (Answer.cuts). InputError: another method than "micp".
    """
    if formulation.method != "micp":
        raise InputError(f'method: the branch and bound on clarabel solves "micp", found {formulation.method!r}')
    search = _Search(formulation, options)
    try:
        finished = search.run()
    except KeyboardInterrupt:
        finished = False
    return search.answer(finished)


class _Search:
    """Best bound first, with dives along the child in which the branching edge is flown.

    A node is the set of edges left to it: branching on an edge takes away either its rivals or the edge itself.
    """

    def __init__(self, formulation, options):
        self.start = time.perf_counter()
        self.options, self.graph, self.n_agents = options, formulation.graph, formulation.n_agents
        self.relaxation = Perspective(conic_program(formulation), self.graph, self.n_agents, options.threads)
        self.heap, self.order = [], itertools.count()
        self.current = 0.0  # bound of the node at hand; 0 is a bound of every length
        self.closed = math.inf  # least bound at which something was given up for being no better than the incumbent
        self.length, self.flow = math.inf, None
        self.nodes = self.cuts = 0
        self.tried = set()

    @property
    def cutoff(self):
        """What is at least this long is not worth looking for."""
        return self.length * (1.0 - max(self.options.gap, LEAST_GAP))

    @property
    def bound(self):
        """A lower bound on every set of tours, at any time."""
        return min(self.length, self.closed, self.current, *(bound for bound, _, _ in self.heap[:1]))

    def run(self):
        """Search until the gap is proved; return False if the time limit came first."""
        self._push(0.0, np.ones(len(self.graph.edges), dtype=bool))
        while self.heap and self.heap[0][0] < self.cutoff:
            self.current = self.heap[0][0]  # before the node is taken off, so that `bound` holds at any moment
            bound, _, alive = heapq.heappop(self.heap)
            if not self._dive(bound, alive):
                return False
            self.current = math.inf
        return True

    def _push(self, bound, alive):
        heapq.heappush(self.heap, (bound, next(self.order), alive))

    def _dive(self, bound, alive):
        """Follow one branch down until nothing better is left in it; return False if time ran out."""
        while True:
            if self._time_left() <= 0:
                return False
            found = self._process(bound, alive)
            self._report("search")
            if found is None:
                return True
            bound, alive, y = found
            self.current = bound
            children = branch(self.graph, y, alive)
            if children is None:
                self._try_last(alive)
                return True
            alive, other = children
            self._push(bound, other)

    def _process(self, bound, alive):
        """Return (bound, alive, y) of a node with less left to it, or None if nothing better than the incumbent is."""
        while True:
            possible = propagate(self.graph, alive)
            if possible is None:
                return None
            alive, times = possible
            relaxed = self.relaxation.relax(alive, times, self._time_left())
            self.nodes += 1
            bound = max(bound, relaxed.bound)
            if bound >= self.cutoff or not self._cut_subtours(relaxed.y):
                break
        if not math.isinf(bound):
            self._try(round_flow(self.graph, relaxed.y, alive, self.n_agents))
        if bound >= self.cutoff:
            self.closed = min(self.closed, bound)
            return None
        return bound, self._without_dear_edges(bound, alive, relaxed.extra), relaxed.y

    def _cut_subtours(self, y):
        """Cut off the sets of targets that the flow y enters less than once; tell whether there were any."""
        sets = violated_sets(self.graph, y)
        inside = [np.isin(self.graph.tau[self.graph.edges], S).all(axis=1) for S in sets]
        if sets:
            self.relaxation.add_cuts([(np.flatnonzero(edges), len(S) - 1) for S, edges in zip(sets, inside)])
            self.cuts += len(sets)
        return bool(sets)

    def _try(self, routes):
        """Take the routes, with their best times, as the new incumbent if they can be flown and are shorter."""
        if routes is None or (key := tuple(routes)) in self.tried:
            return
        self.tried.add(key)
        found = best_tours(self.graph, [list(route) for route in routes])
        if found is not None and found[0] < self.length:
            self.length, self.flow = found[0], _flow_of(self.graph, routes)

    def _try_last(self, alive):
        """Try the one choice of edges that a node has left."""
        paths, cycles = read_flow(self.graph, alive)
        if not cycles:
            self._try(paths)

    def _without_dear_edges(self, bound, alive, extra):
        """Take away the edges that no solution better than the incumbent can fly."""
        dear = alive & (bound + extra >= self.cutoff)
        if dear.any():
            self.closed = min(self.closed, (bound + extra)[dear].min())
        return alive & ~dear

    def _time_left(self):
        limit = self.options.time_limit
        return math.inf if limit is None else limit - (time.perf_counter() - self.start)

    def _report(self, phase):
        if self.options.progress is not None:
            length = self.length if self.flow is not None else None
            spent = time.perf_counter() - self.start
            self.options.progress(Progress(spent, length, self.bound, relative_gap(length, self.bound), self.nodes, phase))

    def answer(self, finished):
        """Return the Answer as things stand."""
        if finished:
            status = INFEASIBLE if self.flow is None else OPTIMAL
        else:
            status = UNKNOWN if self.flow is None else FEASIBLE
        known = self.flow is not None
        return Answer(
            status=status,
            objective=self.length if known else None,
            bound=None if status == INFEASIBLE else self.bound,
            flow=self.flow,
            nodes=self.nodes,
            runtime=time.perf_counter() - self.start,
            solver=f"clarabel {clarabel.__version__}",
            cuts=self.cuts,
        )


def _flow_of(graph, routes):
    """Return the flow (|E|,) of routes through the graph."""
    number = {edge: e for e, edge in enumerate(map(tuple, graph.edges.tolist()))}
    flow = np.zeros(len(graph.edges))
    for route in routes:
        stops = [graph.s, *route, graph.s_prime]
        flow[[number[edge] for edge in zip(stops[:-1], stops[1:])]] = 1.0
    return flow
