"""The paper's three formulations, in Pyomo and (two of them) in cvxpy, their sizes, and the maps between them."""

from .formulation import Formulation, build_formulation

__all__ = ["Formulation", "build_formulation"]
