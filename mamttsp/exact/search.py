"""The search: tours first, then nodes, each bounded, enumerated, cut finer or split, until the gap is closed.

See README.md for a round as a diagram.
"""

import numpy as np

from ..options import Progress
from ..timing import leg_lengths
from .column_generation import ColumnGeneration
from .evaluation import first_network
from .node import Node
from .pieces import even_cuts
from .standing import Standing


def luby(k):
    """Return how long the k-th start of a search may take, k = 1, 2, ...: 1, 1, 2, 1, 1, 2, 4, 1, ... (Luby, Sinclair
    and Zuckerman 1993), hardly worse than any other choice where nobody knows how long a good start takes."""
    whole = 1 << k.bit_length() - 1
    return whole if k + 1 == 2 * whole else luby(k + 1 - whole)


class Search:
    """A run of the exact solver for the targets of a graph; what it has found and proved is in `standing`.

    annealing: looks for tours; start: routes of segments to begin with, or none. nodes: the open ones, which hold every
    solution below the limit; labels: made by enumerations; starts: how often tours were looked for from nothing;
    choosing: seconds that choices among known routes took.
    """

    def __init__(self, graph, fleet, gap, clock, parameters, annealing, progress=None, start=()):
        self.graph, self.n, self.fleet, self.m = graph, graph.n_targets, fleet, fleet.n_agents
        self.clock, self.parameters, self.progress, self.annealing = clock, parameters, progress, annealing
        self.standing, self.unit, self.nodes = Standing(graph, fleet, gap), graph.size or 1.0, []
        self.labels, self.columns, self.starts, self.choosing = 0, 0, 0, 0.0
        if start:
            self.incumbent.offer(start)

    @property
    def incumbent(self):
        return self.standing.incumbent

    @property
    def limit(self):
        return self.standing.limit

    @property
    def arcs(self):
        """How many arcs the open nodes have."""
        return sum(len(node.generation.network.arcs.head) for node in self.nodes)

    def report(self, phase):
        if self.progress:
            self.progress(Progress(self.clock.spent, *self.standing.figures(), self.labels, phase, self.columns))

    def over(self):
        """Whether the run has to end: less time than another evaluation takes is as good as none."""
        late = any(node.generation.late(self.clock) for node in self.nodes)
        return self.standing.closed() or self.clock.out() or late

    def run(self):
        """Run until the gap is closed, infeasibility is proved, time is up, or nothing is left that could help."""
        self.search_tours()
        self.nodes = [self.root()]
        while not self.over():
            if not (going := [node for node in self.nodes if not node.exhausted]):
                break
            node = self.chosen(going)
            others = [other for other in self.nodes if other is not node]
            self.nodes = [left for left in others + node.round() if left.bound < self.limit]
            self.raise_bound()

    def chosen(self, nodes):
        """Return the node of the least bound; the latest, which are few, where nodes take up too much memory."""
        return nodes[-1] if self.arcs > self.parameters.most_arcs else min(nodes, key=lambda node: node.bound)

    def root(self):
        """Return the Node of all solutions."""
        width = self.first_width()
        network = first_network(self.graph, even_cuts(self.graph, self.graph.V_seg, width), range(self.n))
        prices = self.first_prices()
        return Node(
            self, ColumnGeneration(network, self.n, self.fleet, prices, self.parameters, self.unit), width
        )  # fmt: skip

    def raise_bound(self):
        """A solution below the limit is in an open node."""
        self.standing.raise_bound(min((node.bound for node in self.nodes), default=self.limit))

    def first_width(self):
        """Return the length of the first pieces in s: a share of the time there is for each target, or of its windows
        in the mean if that is less, but no more pieces than a few; more if many targets are open at once."""
        graph, p = self.graph, self.parameters
        start, end = graph.t_lo[graph.V_seg], graph.t_hi[graph.V_seg]
        windows, time, layers = (end - start).sum(), end.max() - start.min(), graph.n_layers
        most = p.crowded_pieces if windows > p.ng_size * layers * time else p.first_pieces
        width = min(p.piece * time / self.n, windows / (self.n * layers * p.pieces_each))
        return max(width, windows / most, 1e-6 * graph.horizon)

    def first_prices(self):
        """Return (n,) half of the legs to and from each target in the incumbent, damped; even prices without one."""
        pi = np.full(self.n, self.unit / self.n)
        for route in self.incumbent.routes:
            _, times, _ = self.incumbent.timed(route)
            legs = leg_lengths(self.graph, route, times)
            pi[self.graph.tau[list(route)]] = 0.25 * (legs[:-1] + legs[1:])
        return pi

    def search_more_tours(self, work):
        """Look for tours again, if what that takes is cheap beside the entries that prices have extended."""
        done, more = sum(map(luby, range(1, self.starts + 1))), luby(self.starts + 1)
        if (self.parameters.annealing_share * work - self.annealing.filled) * done >= self.annealing.filled * more:
            self.search_tours()

    def search_tours(self):
        """Look for tours by ruin and recreate, from nothing, but no longer than a share of the time that is left, then
        among all routes known."""
        p = self.parameters
        self.starts += 1
        looks, enough = self.n * p.annealing * luby(self.starts), (1.0 - p.annealing_most) * self.clock.seconds
        looks, iterations = max(1, round(looks)), min(self.n * p.annealing_step, p.annealing_longest)
        self.annealing.begin()
        for look in range(looks):
            if self.clock.out() or self.clock.seconds < enough:
                break
            if routes := self.annealing.run(iterations, 1.0 - look / looks, 1.0 - (look + 1) / looks):
                self.incumbent.offer(routes)
        self.recombine()
        self.report("heuristic")

    def recombine(self):
        if self.m > 1 and not self.clock.out():
            p, begun = self.parameters, self.clock.spent
            seconds = max(p.choice_seconds, p.choice_share * begun - self.choosing)
            self.incumbent.recombine(min(seconds, self.clock.seconds))
            self.choosing += self.clock.spent - begun
