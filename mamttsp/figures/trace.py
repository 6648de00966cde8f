"""The trace of a solve: incumbent and bound on their way to each other."""

import numpy as np

from ..options import Progress
from ..validation import InputError, brief, listed
from .canvas import canvas
from .style import COLOURS

_AXES = {"time": "time (s)", "report": "report, and the phase that begins there"}


def trace_view(steps, against="time", ax=None):
    """Draw incumbent and bound of a solve, the gap between them grey, and return the axes.

    steps: the Progress reports in order, e.g. a `display.Trace`; against: "time", s, or "report", their number, which
    is the same on every machine; below it is the phase, where one begins. InputError: no such reports, another
    `against`, or no axes.

    >>> from mamttsp import generate, solve
    >>> from mamttsp.figures import trace_view
    >>> steps = []
    >>> solution = solve(generate(n_targets=3, total_window=20, seed=1), progress=steps.append)
    >>> trace_view(steps).get_ylabel()
    'length (units)'
    """
    steps = listed("steps", steps, Progress)
    if against not in _AXES:
        raise InputError(f"against: expected one of {', '.join(_AXES)}, found {brief(against)}")
    ax = canvas(ax, (7, 4.5))
    x = [step.time for step in steps] if against == "time" else np.arange(1, len(steps) + 1)
    bound, best = (_lengths(getattr(step, name) for step in steps) for name in ("bound", "objective"))
    ax.fill_between(x, bound, best, step="post", color="0.9", zorder=0, label="gap")
    ax.step(x, best, where="post", color=COLOURS[1], marker="s", markersize=5, label="incumbent")
    ax.step(x, bound, where="post", color=COLOURS[0], linestyle="--", marker="o", markersize=5, label="bound")
    ax.set(xlabel=_AXES[against], ylabel="length (units)")
    if against == "report":
        begins = [k for k, step in enumerate(steps) if k == 0 or step.phase != steps[k - 1].phase]
        ax.set_xticks(x[begins], [f"{k + 1} {steps[k].phase}" for k in begins], rotation=60, ha="right")
    ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0, frameon=False)
    return ax


def _lengths(values):
    """Return the lengths as an array, NaN where there is none yet."""
    return np.array([np.nan if value is None else value for value in values])
