"""The log of a solve, in the manner of a MIP solver: recorded, printed row by row, or both."""

import sys

from .progress import number


class Trace:
    """Records every Progress it is called with: `solve(..., progress=trace)`, then `trace.steps`, or iterate over it.

    then: another callback, e.g. a ProgressLog, that is handed each Progress as well.
    """

    def __init__(self, then=None):
        self.steps, self.then = [], then

    def __call__(self, step):
        self.steps.append(step)
        if self.then:
            self.then(step)

    def __iter__(self):
        return iter(self.steps)

    def table(self, times=True):
        """Return the log as text, a row for each Progress; without times the same run gives the same text."""
        return "\n".join([log_header(times), *(log_row(step, times) for step in self.steps)])


class ProgressLog:
    """Prints each Progress it is called with as a row of a table."""

    def __init__(self, stream=None):
        self.stream, self._begun = stream or sys.stdout, False

    def __call__(self, step):
        if not self._begun:
            print(log_header(), file=self.stream)
            self._begun = True
        print(log_row(step), file=self.stream, flush=True)


def log_header(times=True):
    """Return the names above the rows of `log_row`."""
    return _row("phase", "nodes", "columns", "incumbent", "bound", "gap", "time" if times else None)


def log_row(step, times=True):
    """Return a Progress as a row: lengths in units, the gap in per cent, the time in s."""
    gap = "-" if step.gap is None else f"{100 * step.gap:.4f} %"
    nodes, columns = ("-" if count is None else str(count) for count in (step.nodes, step.columns))
    seconds = f"{step.time:.1f} s" if times else None
    return _row(step.phase, nodes, columns, number(step.objective), number(step.bound), gap, seconds)


def _row(phase, nodes, columns, incumbent, bound, gap, time):
    row = f"{phase:<12}{nodes:>10}{columns:>10}{incumbent:>14}{bound:>14}{gap:>13}"
    return row if time is None else f"{row}{time:>11}"
