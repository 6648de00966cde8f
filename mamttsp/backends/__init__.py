"""Back ends: each hands a built formulation to one solver and reads its answer.

A back end is a module with `solve(formulation, options) -> Answer`. It is imported when its name is asked for, so a
solver that is not installed costs nothing and harms nobody.
"""

from importlib import import_module

from ..instance import InputError
from .answer import Answer, Options, Progress, SolverUnavailable

#: the back ends by name, each the module of that name in this package
SOLVERS = ("scip", "clarabel", "highs", "gurobi", "mosek", "xpress", "copt")

__all__ = ["SOLVERS", "Answer", "Options", "Progress", "SolverUnavailable", "backend"]


def backend(name):
    """Return the back end of that name; InputError if there is none."""
    if name not in SOLVERS:
        raise InputError(f"solver: expected one of {', '.join(SOLVERS)}, found {name!r}")
    return import_module(f".{name}", __name__)
