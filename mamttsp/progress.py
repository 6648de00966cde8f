"""A running solve in one line: time, incumbent, bound, gap, nodes."""

import time

#: least time in s between two lines where the last one cannot be overwritten
_LINE_EVERY = 5.0


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


def format_progress(step):
    """Return a Progress as one line of text."""
    gap = "-" if step.gap is None else f"{100 * step.gap:.2f} %"
    nodes = "" if step.nodes is None else f"  nodes {step.nodes}"
    lengths = f"incumbent {number(step.objective)}  bound {number(step.bound)}"
    return f"{step.time:7.1f} s  {lengths}  gap {gap}{nodes}  {step.phase}"


def number(value):
    """Return a length as text, a dash where it is unknown."""
    return "-" if value is None else f"{value:.4f}"
