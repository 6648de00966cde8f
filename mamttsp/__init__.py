"""Multi-Agent Moving-Target Traveling Salesman Problem: the paper's formulations, checked, and an exact solver."""

import importlib
from typing import TYPE_CHECKING

from .agents import Agents
from .backends import Progress, SolverUnavailable
from .generate import generate, paper_instance
from .instance import Instance, Target
from .library import load
from .look import plot, visits
from .solution import Solution
from .solve import solve
from .tours import Tour, TourError, Visit, check
from .validation import InputError
from .versions import VERSION as __version__  # noqa: F401

if TYPE_CHECKING:
    from . import figures
    from .flow import FlowError
    from .graph import build_graph
    from .plain_model import PaperSolution

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
    "figures",
    "generate",
    "load",
    "paper_instance",
    "plot",
    "solve",
    "visits",
]

#: public names that are imported when they are first asked for, because what they need takes its time: the module of
#: each, which is the name itself for a module
_LATER = {"FlowError": "flow", "PaperSolution": "plain_model", "build_graph": "graph", "figures": "figures"}


def __getattr__(name: str) -> object:
    if name not in _LATER:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    module = importlib.import_module(f".{_LATER[name]}", __name__)
    return module if name == _LATER[name] else getattr(module, name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
