"""One wrapper for a built model of either modeler: what back ends and `solve()` need to know of it."""

import abc
import importlib
import time

import numpy as np

from ..validation import InputError
from .equations import EQUATIONS

MODELERS = ("pyomo", "cvxpy")


class Formulation(abc.ABC):
    """A built model of one of the paper's formulations.

    method: "baseline", "nonconvex" or "micp"; modeler: "pyomo" or "cvxpy"; graph: the Graph; counts: (K,) how many
    agents there are in each of its layers, and n_agents: m, how many in all; model: a Pyomo ConcreteModel, or an
    instance of the cvxpy class; build_time: wall time of the build in s.
    """

    modeler = None

    def __init__(self, method, graph, n_agents):
        self.method, self.graph = method, graph
        self.counts = graph.counts if n_agents is None else np.array([n_agents])
        self.n_agents = int(self.counts.sum())
        build = self._builder()
        start = time.perf_counter()
        self.model = build(graph, self.n_agents)
        self.build_time = time.perf_counter() - start

    @abc.abstractmethod
    def _builder(self):
        """Return the function (graph, n_agents) -> model; its module is imported here, outside the build time."""

    def flow(self):
        """Return (|E|,) the values of y summed over the agents; NaN where no solution is loaded."""
        return self._y_values().reshape(len(self.graph.edges), -1).sum(axis=1)

    @abc.abstractmethod
    def _y_values(self):
        """Return the values of y, edges first."""

    def add_subtour_cut(self, targets):
        """Forbid cycles among `targets` (numbered from 0) that miss the depot, in the model at hand.

        With E(S) the edges among their segments: y(E(S)) <= |targets| - 1. As each target is entered once, this says
        y(delta^-(S)) >= 1, an agent comes from outside; it holds its own where pruning has left no edge from outside.
        """
        inside = np.isin(self.graph.tau, list(targets))
        i, j = self.graph.edges.T
        self._limit(np.flatnonzero(inside[i] & inside[j]), len(targets) - 1)

    def add_path_cut(self, path):
        """Forbid one agent to leave the depot and visit the segments of `path` in order: y(path) <= |path| - 1.

        Their targets are entered once each, so a full flow along the path would be the flow of a single agent.
        """
        index = {edge: e for e, edge in enumerate(map(tuple, self.graph.edges.tolist()))}
        start = int(self.graph.starts[self.graph.layer[path[0]]])
        self._limit([index[edge] for edge in zip((start, *path[:-1]), path)], len(path) - 1)

    @abc.abstractmethod
    def _limit(self, edges, limit):
        """Add the cut y(edges) <= limit, summed over the agents; edges: their indices."""

    def statistics(self):
        """Return the model's size as Statistics."""
        from .statistics import statistics

        return statistics(self.model)

    @abc.abstractmethod
    def conic_program(self):
        """Return the ConicProgram of the model (baseline or MICP), with the cuts that it has by now."""


class PyomoFormulation(Formulation):
    """A formulation as a Pyomo ConcreteModel; `y` runs over the edges first and then, if it has them, over agents."""

    modeler = "pyomo"

    def _builder(self):
        from pyomo.common.gc_manager import PauseGC

        build = importlib.import_module(f".pyomo.{self.method}", __package__).build

        def build_without_collector(graph, n_agents):
            with PauseGC():  # a model is many small objects: this makes the build three times as fast
                return build(graph, n_agents)

        return build_without_collector

    def _y_values(self):
        return np.array([y.value for y in self.model.y.values()], dtype=float)

    def _limit(self, edges, limit):
        from pyomo.environ import quicksum

        y = np.array(list(self.model.y.values()), dtype=object).reshape(len(self.graph.edges), -1)
        self.model.subtour_cuts.add(quicksum(y[edges].flat) <= limit)

    def conic_program(self):
        from .pyomo.standard_form import standard_form

        return standard_form(self.model)


class CvxpyFormulation(Formulation):
    """A formulation as an instance of its cvxpy class; `y` has shape (|E|,) or (|E|, m)."""

    modeler = "cvxpy"

    def _builder(self):
        return getattr(importlib.import_module(f".cvxpy.{self.method}", __package__), self.method.capitalize())

    def _y_values(self):
        y = self.model.y
        return np.full(y.shape, np.nan) if y.value is None else np.asarray(y.value)

    def _limit(self, edges, limit):
        self.model.add_cut(self.model.y[edges].sum() <= limit)

    def conic_program(self):
        from .cvxpy.standard_form import standard_form

        return standard_form(self.model)


def build_formulation(method, modeler, graph, n_agents=None):
    """Build `method` with `modeler` for a Graph and return the Formulation.

    graph: with several types of agents, as `graph_for` has it; n_agents: m, None for the number that the graph has, or
    numbers of its layers. InputError: an unknown method or modeler, a method that the modeler cannot state, or one
    number for several layers.
    """
    if method not in EQUATIONS:
        raise InputError(f"method: expected one of {', '.join(EQUATIONS)} for a formulation, found {method!r}")
    if modeler not in MODELERS:
        raise InputError(f"modeler: expected one of {', '.join(MODELERS)}, found {modeler!r}")
    if graph.n_layers > 1 and n_agents is not None:
        raise InputError(f"n_agents: the {graph.n_layers} layers of the graph have their own numbers of agents")
    kind = PyomoFormulation if modeler == "pyomo" else CvxpyFormulation
    return kind(method, graph, n_agents)


def graph_for(method, instance, prune=False):
    """Return the Graph on which `method` states an instance, see `build_graph`.

    The MICP has a flow for each type of agents. The other two have one for each agent; agents of a single type share
    a layer all the same, as in the paper.
    """
    from ..graph import build_graph  # here: numba behind it takes its time to import

    return build_graph(instance, prune, by_agent=method != "micp" and len(instance.agents) > 1)
