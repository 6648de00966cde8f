"""The bar of a campaign: on a terminal tqdm's, elsewhere a line now and then, as a log file can hold it."""

import sys
import time

from tqdm import tqdm

#: least time in s between two lines
_LINE_EVERY = 60.0


def campaign_bar(total, done, quiet=False, stream=None):
    """Return a context manager with `update()`, for a run that is done, and `set_postfix_str(text)`, of those in work.

    total, done: how many runs there are, and how many of them were done before; stream: standard error if None.
    """
    stream = sys.stderr if stream is None else stream
    if quiet or stream.isatty():
        return tqdm(total=total, initial=done, unit="run", disable=quiet, file=stream)
    return _Lines(total, done, stream)


class _Lines:
    """The same for a stream that cannot be written over: a line at most once a minute, and one at the end."""

    def __init__(self, total, done, stream):
        self.total, self.done, self.stream, self.under_way = total, done, stream, ""
        self.start = self.last = time.monotonic()

    def update(self):
        self.done += 1
        self._show_now_and_then()

    def set_postfix_str(self, text):
        self.under_way = text
        self._show_now_and_then()

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        self.under_way = ""
        self._show()

    def _show_now_and_then(self):
        if time.monotonic() >= self.last + _LINE_EVERY:
            self._show()

    def _show(self):
        self.last = time.monotonic()
        minutes, seconds = divmod(int(self.last - self.start), 60)
        text = f"{self.done} of {self.total} runs after {minutes}:{seconds:02} min, {self.under_way}".rstrip(", ")
        print(text, file=self.stream, flush=True)
