"""Multi-Agent Moving-Target Traveling Salesman Problem: the paper's formulations, checked, and an exact solver."""

import importlib

from .agents import Agents
from .backends import Progress, SolverUnavailable
from .flow import FlowError
from .generate import generate, paper_instance
from .graph import build_graph
from .instance import Instance, Target
from .look import plot, visits
from .plain_model import PaperSolution
from .solution import Solution
from .solve import solve
from .tours import Tour, TourError, Visit, check
from .validation import InputError

__version__ = "0.1.0"
__all__ = [
    "Agents",
    "FlowError",
    "InputError",
    "Instance",
    "PaperSolution",
    "Progress",
    "Solution",
    "SolverUnavailable",
    "Target",
    "Tour",
    "TourError",
    "Visit",
    "build_graph",
    "check",
    "generate",
    "paper_instance",
    "plot",
    "solve",
    "visits",
]


def __getattr__(name):
    # Matplotlib takes its time, so the drawings come only when somebody asks for them.
    if name == "figures":
        return importlib.import_module(".figures", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
