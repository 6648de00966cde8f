"""What every back end takes and gives: Options in, Progress on the way, Answer out."""

import dataclasses
import math
from collections.abc import Callable
from numbers import Real

import numpy as np

from ..instance import InputError
from ..solution import STATUSES


class SolverUnavailable(InputError):
    """A solver that cannot be used here: not installed, no licence, or a model beyond a trial licence."""


def licence_trouble(solver, error):
    """Return the SolverUnavailable for a solver's own error about a licence that is missing or too small."""
    reason = str(error).strip().splitlines()[0]
    return SolverUnavailable(f"solver: {solver} cannot solve this model with the licence at hand: {reason}")


@dataclasses.dataclass(frozen=True)
class Progress:
    """A running solve at one moment.

    time: s since its start; objective, bound, gap: best so far, None while unknown (gap as a fraction);
    nodes: branch-and-bound nodes, labels of the exact solver, None where the solver has none; phase: one or two words,
    e.g. "scip" or "dive"; columns: routes that the exact solver has closed, None where a solver has none.
    """

    time: float
    objective: float | None
    bound: float | None
    gap: float | None
    nodes: int | None
    phase: str
    columns: int | None = None


@dataclasses.dataclass(frozen=True)
class Options:
    """Limits and switches that mean the same for every back end.

    time_limit: s, None for none; gap: relative gap (a fraction) at which a solve is optimal; threads: at least 1;
    seed: of the solver's own random choices; verbose: let the solver print its log; progress: called with a Progress
    now and then. A limit or KeyboardInterrupt ends a solve with what stands, never with an exception.
    """

    time_limit: float | None = None
    gap: float = 1e-4
    threads: int = 1
    seed: int = 0
    verbose: bool = False
    progress: Callable[[Progress], None] | None = None

    def __post_init__(self):
        if self.time_limit is not None:
            _number("time_limit", self.time_limit, 0.0, strict=True)
        _number("gap", self.gap, 0.0)
        _whole("threads", self.threads, 1)
        _whole("seed", self.seed, 0)


@dataclasses.dataclass(frozen=True, eq=False)
class Answer:
    """What a solver says of one model, before anyone has looked at the tours.

    status: one of solution.STATUSES; objective: of the best point found, None without one; bound: proved lower bound,
    None if none is known; flow: (|E|,) of y summed over agents at that point, None without one; nodes: branch-and-bound
    nodes or None; runtime: s; solver: name and version, e.g. "scip 10.0"; cuts: subtour cuts added on the way.
    """

    status: str
    objective: float | None
    bound: float | None
    flow: np.ndarray | None
    nodes: int | None
    runtime: float
    solver: str
    cuts: int = 0

    def __post_init__(self):
        if self.status not in STATUSES:
            raise ValueError(f"status {self.status!r} is not one of {STATUSES}")
        for name in ("objective", "bound"):
            if (value := getattr(self, name)) is not None:
                object.__setattr__(self, name, float(value))


def known_length(value):
    """Return a length or a bound on it as a float of at least 0, or None for infinity and what solvers use as such."""
    if value is None or not math.isfinite(value) or abs(value) >= 1e20:
        return None
    return max(float(value), 0.0)


def _number(name, value, least, strict=False):
    good = isinstance(value, Real) and not isinstance(value, bool) and math.isfinite(value)
    if not good or value < least or (strict and value == least):
        raise InputError(f"{name}: expected a number {'above' if strict else 'of at least'} {least:g}, found {value!r}")


def _whole(name, value, least):
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < least:
        raise InputError(f"{name}: expected a whole number of at least {least}, found {value!r}")
