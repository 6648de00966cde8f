"""Limits and switches of a solve, what it reports on the way, and the clock that a limit or Ctrl-C ends."""

import dataclasses
import math
import signal
import threading
import time
from collections.abc import Callable
from numbers import Real

import numpy as np

from .tours import Tour
from .validation import InputError, brief


@dataclasses.dataclass(frozen=True)
class Progress:
    """A running solve at one moment.

    time: s since its start; objective, bound, gap: best so far, None while unknown (gap as a fraction);
    nodes: branch-and-bound nodes, labels of the exact solver, None where the solver has none; phase: one or two words,
    e.g. "scip" or "dive"; columns: routes that the exact solver has closed, None where a solver has none.

    >>> from mamttsp import generate, solve
    >>> seen = []
    >>> solution = solve(generate(n_targets=5, total_window=20, seed=1), progress=seen.append)
    >>> seen[-1].objective == solution.objective
    True
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
    """Limits and switches that mean the same for every back end, but where this text says otherwise.

    time_limit: s, None for none; gap: relative gap (a fraction) at which a solve is optimal; verbose: let the solver
    print its log; start: tours of the instance, checked, to begin from, or None. A limit or KeyboardInterrupt ends a
    solve with what stands, never with an exception.
    threads: at least 1. SCIP's own search uses no more than one, and the exact method refuses more.
    seed: of the solver's own random choices. Our branch and bound has none, and COPT has no such parameter.
    progress: called with a Progress now and then. MOSEK does not, nor does a commercial solver with a Pyomo model.
    """

    time_limit: float | None = None
    gap: float = 1e-4
    threads: int = 1
    seed: int = 0
    verbose: bool = False
    progress: Callable[[Progress], None] | None = None
    start: tuple[Tour, ...] | None = None

    def __post_init__(self) -> None:
        if self.time_limit is not None:
            _number("time_limit", self.time_limit, 0.0, strict=True)
        _number("gap", self.gap, 0.0)
        _whole("threads", self.threads, 1)
        _whole("seed", self.seed, 0)
        if self.progress is not None and not callable(self.progress):
            raise InputError(f"progress: expected a function of a Progress, found {brief(self.progress)}")


class Clock:
    """Counts from its creation, or from `start` (a perf_counter()); limit: s, None for none."""

    def __init__(self, limit: float | None = None, start: float | None = None) -> None:
        self.limit = limit
        self.start = time.perf_counter() if start is None else start

    @property
    def spent(self) -> float:
        """Seconds since the start."""
        return time.perf_counter() - self.start

    @property
    def left(self) -> float | None:
        """Seconds left, at least 0; None without a limit."""
        return None if self.limit is None else max(self.limit - self.spent, 0.0)

    @property
    def over(self) -> bool:
        """Whether the limit has come."""
        return self.left == 0.0


class Watch(Clock):
    """A Clock that Ctrl-C ends as well. As a context manager it takes Ctrl-C over, because compiled code must not be
    broken off in the middle: the run ends at its next look at `out`, with what stands."""

    def __init__(self, limit: float | None = None) -> None:
        super().__init__(limit)
        self._stopped = False

    def out(self) -> bool:
        """Whether the run has to end."""
        return self._stopped or self.over

    @property
    def seconds(self) -> float:
        """Seconds left, infinite without a limit."""
        return math.inf if self.left is None else self.left

    def __enter__(self):
        self._main = threading.current_thread() is threading.main_thread()
        if self._main:
            self._handler = signal.signal(signal.SIGINT, self._stop)
        return self

    def __exit__(self, *exception):
        if self._main:
            signal.signal(signal.SIGINT, self._handler)

    def _stop(self, *_):
        self._stopped = True


def _number(name, value, least, strict=False):
    good = isinstance(value, Real) and not isinstance(value, bool) and math.isfinite(value)
    if not good or value < least or (strict and value == least):
        raise InputError(
            f"{name}: expected a number {'above' if strict else 'of at least'} {least:g}, found {brief(value)}"
        )


def _whole(name, value, least):
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < least:
        raise InputError(f"{name}: expected a whole number of at least {least}, found {brief(value)}")
