"""A running solve in one line that is written over: on a terminal, in a notebook, or now and then into a file."""

import sys
import time

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
        self.stream, self.on = stream, on
        self.terminal = stream.isatty()
        self.width = 0
        self.last = time.monotonic()

    def __call__(self, step):
        if not self.on:
            return
        text = format_progress(step)
        if self.terminal:
            self._overwrite(text)
        elif time.monotonic() >= self.last + _LINE_EVERY:
            self.last = time.monotonic()
            print(text, file=self.stream, flush=True)

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        if self.width:
            self._overwrite("")
            self.stream.write("\r")

    def _overwrite(self, text):
        self.stream.write("\r" + text.ljust(self.width))
        self.stream.flush()
        self.width = len(text)


class NotebookLine:
    """Shows each Progress it is called with under the cell that runs, over the last one.

    A context manager: leaving it empties the line, so that a saved notebook holds no half-done run.
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


def number(value):
    """Return a length as text, a dash where it is unknown."""
    return "-" if value is None else f"{value:.4f}"
