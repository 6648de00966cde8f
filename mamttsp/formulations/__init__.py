"""The paper's three formulations, in Pyomo and (two of them) in cvxpy, their sizes, and the maps between them."""

from .equations import METHODS
from .formulation import MODELERS, Formulation, build_formulation, graph_for

__all__ = ["METHODS", "MODELERS", "Formulation", "build_formulation", "graph_for"]
