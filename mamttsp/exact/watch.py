"""When a run has to end: its time limit, or Ctrl-C."""

import math
import signal
import threading

from ..backends.clock import Clock


class Watch(Clock):
    """A Clock that Ctrl-C ends as well. As a context manager it takes Ctrl-C over, because compiled code must not be
    broken off in the middle: the run ends at its next look at `out`, with what stands."""

    def __init__(self, limit=None):
        super().__init__(limit)
        self._stopped = False

    def out(self):
        """Whether the run has to end."""
        return self._stopped or self.over

    @property
    def seconds(self):
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
