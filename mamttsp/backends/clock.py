"""Wall time since a start, and what a limit leaves of it."""

import time


class Clock:
    """Counts from its creation, or from `start` (a perf_counter()); limit: s, None for none."""

    def __init__(self, limit=None, start=None):
        self.limit = limit
        self.start = time.perf_counter() if start is None else start

    @property
    def spent(self):
        """Seconds since the start."""
        return time.perf_counter() - self.start

    @property
    def left(self):
        """Seconds left, at least 0; None without a limit."""
        return None if self.limit is None else max(self.limit - self.spent, 0.0)

    @property
    def over(self):
        """Whether the limit has come."""
        return self.left == 0.0
