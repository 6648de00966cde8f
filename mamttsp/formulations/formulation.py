"""One wrapper for a built model of either modeler: what back ends and `solve()` need to know of it."""

import importlib
import time

import numpy as np
import pyomo.environ as pyo

from ..instance import InputError
from .equations import EQUATIONS
from .statistics import statistics

MODELERS = ("pyomo", "cvxpy")


class Formulation:
    """A built model of one of the paper's formulations.

    method: "baseline", "nonconvex" or "micp"; modeler: "pyomo" or "cvxpy"; graph: the Graph; n_agents: m;
    model: a Pyomo ConcreteModel, or an instance of the cvxpy class; build_time: wall time of the build in s.
    """

    modeler = None

    def __init__(self, method, graph, n_agents):
        self.method, self.graph, self.n_agents = method, graph, n_agents
        start = time.perf_counter()
        self.model = self._build()
        self.build_time = time.perf_counter() - start

    def flow(self):
        """Return (|E|,) the values of y summed over the agents; NaN where no solution is loaded."""
        return self._y_values().reshape(len(self.graph.edges), -1).sum(axis=1)

    def add_subtour_cut(self, targets):
        """Forbid cycles among `targets` (numbered from 0): y(E(S)) <= |S| - 1, E(S) being the edges among them.

        With each target entered once this says y(delta^-(S)) >= 1: an agent comes to these targets from outside. The
        form chosen here also holds its own where pruning has left no edge from outside.
        """
        inside = np.isin(self.graph.tau, list(targets))
        i, j = self.graph.edges.T
        self._add_cut(np.flatnonzero(inside[i] & inside[j]), len(targets) - 1)

    def add_path_cut(self, path):
        """Forbid one agent to leave the depot and visit the segments of `path` in order: y(path) <= |path| - 1.

        Their targets are entered once each, so a full flow along the path is the flow of a single agent.
        """
        index = {edge: e for e, edge in enumerate(map(tuple, self.graph.edges.tolist()))}
        edges = [index[edge] for edge in zip((self.graph.s, *path[:-1]), path)]
        self._add_cut(np.array(edges), len(edges) - 1)

    def statistics(self):
        """Return the model's size as Statistics."""
        return statistics(self.model)


class PyomoFormulation(Formulation):
    """A formulation as a Pyomo ConcreteModel; `y` runs over the edges first and then, if it has them, over agents."""

    modeler = "pyomo"

    def _build(self):
        return importlib.import_module(f".{self.method}", __package__).build(self.graph, self.n_agents)

    def _y_values(self):
        return np.array([y.value for y in self.model.y.values()], dtype=float)

    def _add_cut(self, edges, limit):
        y = np.array(list(self.model.y.values()), dtype=object).reshape(len(self.graph.edges), -1)
        self.model.subtour_cuts.add(pyo.quicksum(y[edges].flat) <= limit)


class CvxpyFormulation(Formulation):
    """A formulation as an instance of its cvxpy class; `y` has shape (|E|,) or (|E|, m)."""

    modeler = "cvxpy"

    def _build(self):
        module = importlib.import_module(f".cvxpy.{self.method}", __package__)
        return getattr(module, self.method.capitalize())(self.graph, self.n_agents)

    def _y_values(self):
        y = self.model.y
        return np.full(y.shape, np.nan) if y.value is None else np.asarray(y.value)

    def _add_cut(self, edges, limit):
        cut = self.model.y[edges].sum() <= limit
        self.model.constraints.setdefault("subtour_cuts", []).append(cut)


def build_formulation(method, modeler, graph, n_agents):
    """Build `method` with `modeler` for a Graph and m agents and return the Formulation.

    InputError: an unknown method or modeler, or a method that the modeler cannot state.
    """
    if method not in EQUATIONS:
        raise InputError(f"method: expected one of {', '.join(EQUATIONS)} for a formulation, found {method!r}")
    if modeler not in MODELERS:
        raise InputError(f"modeler: expected one of {', '.join(MODELERS)}, found {modeler!r}")
    kind = PyomoFormulation if modeler == "pyomo" else CvxpyFormulation
    return kind(method, graph, n_agents)
