"""Back ends: each hands a built formulation to one solver and reads its answer.

A back end is a module with `solve(formulation, options) -> Answer`. It is imported when its name is asked for, so a
solver that is not installed costs nothing and harms nobody.
"""

from importlib import import_module

from ..options import Options, Progress
from .answer import Answer, SolverUnavailable
from .registry import METHODS, MODELERS, SOLVERS, STARTS, choose

__all__ = [
    "METHODS",
    "MODELERS",
    "SOLVERS",
    "STARTS",
    "Answer",
    "Options",
    "Progress",
    "SolverUnavailable",
    "backend",
    "choose",
]


def backend(name):
    """Return the back end of that name, one of SOLVERS; SolverUnavailable if its package is not installed."""
    try:
        return import_module(f".{name}", __name__)
    except ImportError as error:
        raise SolverUnavailable(f"solver: {name} is not installed ({error}); install it with pip") from error
