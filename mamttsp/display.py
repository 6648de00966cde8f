"""What people see of a solve while it runs: a line that is written over, or a log."""

import sys
import time

from .solution_table import number

#: least time in s between two lines where the last one cannot be overwritten
_LINE_EVERY = 5.0


def progress_display(stream=sys.stderr):
    """Return what shows a running solve here: a NotebookLine in a notebook, elsewhere a ProgressLine on `stream`.

    Use: `with progress_display() as line: solve(instance, progress=line)`.
    """
    # Whoever runs in a notebook has IPython loaded; nobody else has to load it.
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    return NotebookLine() if getattr(shell, "kernel", None) else ProgressLine(stream)


class ProgressLine:
    """Writes each Progress it is called with to a stream, over the last one on a terminal, else a line now and then.

    A context manager: leaving it clears the line.
    """

    def __init__(self, stream, on=True):
        self.stream, self.on, self.last = stream, on, time.monotonic()
        self._bar = None
        if on and stream.isatty():
            from tqdm import tqdm  # here: nobody else needs it

            self._bar = tqdm(bar_format="{desc}", file=stream, leave=False)

    def __call__(self, step):
        if self._bar is not None:
            self._bar.set_description_str(format_progress(step))
        elif self.on and time.monotonic() >= self.last + _LINE_EVERY:
            self.last = time.monotonic()
            print(format_progress(step), file=self.stream, flush=True)

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        if self._bar is not None:
            self._bar.close()


class NotebookLine:
    """Shows each Progress it is called with under the cell that runs, over the last one.

    A context manager: leaving it empties the line, so that a saved notebook holds no half-done run; tqdm's own bar for
    notebooks would stay in the file.
    """

    def __init__(self):
        self._shown = None

    def __call__(self, step):
        self._show(format_progress(step))

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        if self._shown:
            self._show("")

    def _show(self, text):
        from IPython.display import display

        data = {"text/plain": text}
        if self._shown:
            self._shown.update(data, raw=True)
        else:
            self._shown = display(data, raw=True, display_id=True)


def format_progress(step):
    """Return a Progress as one line of text."""
    gap = "-" if step.gap is None else f"{100 * step.gap:.2f} %"
    nodes = "" if step.nodes is None else f"  nodes {step.nodes}"
    columns = "" if step.columns is None else f"  columns {step.columns}"
    lengths = f"incumbent {number(step.objective)}  bound {number(step.bound)}"
    return f"{step.time:7.1f} s  {lengths}  gap {gap}{nodes}{columns}  {step.phase}"


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
