"""Multi-Agent Moving-Target Traveling Salesman Problem: the paper's formulations, checked, and an exact solver."""

from .generate import generate, paper_instance
from .graph import build_graph
from .instance import InputError, Instance, Target
from .solution import Solution
from .tours import Tour, TourError, Visit, check

__version__ = "0.1.0"
__all__ = [
    "InputError",
    "Instance",
    "Solution",
    "Target",
    "Tour",
    "TourError",
    "Visit",
    "build_graph",
    "check",
    "generate",
    "paper_instance",
]
