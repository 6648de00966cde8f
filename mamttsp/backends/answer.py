"""What every back end gives: an Answer, or the reason why its solver cannot be used."""

import dataclasses

import numpy as np

from ..solution import STATUSES, UNKNOWN
from ..validation import InputError


class SolverUnavailable(InputError):
    """A solver that cannot be used here: not installed, no licence, or a model beyond a trial licence."""


def licence_trouble(solver, error):
    """Return the SolverUnavailable for a solver's own error about a licence that is missing or too small."""
    reason = str(error).strip().splitlines()[0]
    return SolverUnavailable(f"solver: {solver} cannot solve this model with the licence at hand: {reason}")


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


def answer_in_time(run, formulation, options, clock):
    """Return what a back end's `run` answers in the time that is left on the clock, UNKNOWN if none is.

    clock: it began before the model was built; progress counts from there too.
    """
    spent, left = clock.spent, clock.left
    if left == 0.0:
        return Answer(UNKNOWN, None, None, None, None, 0.0, "")
    report = options.progress and (lambda step: options.progress(dataclasses.replace(step, time=step.time + spent)))
    return run(formulation, dataclasses.replace(options, time_limit=left, progress=report))
