"""Settings for every test: figures without a display, and hypothesis with few examples, the same on every run."""

import _thread
import signal
import threading

import hypothesis
import matplotlib
import pytest

matplotlib.use("Agg")
hypothesis.settings.register_profile("few", max_examples=8, deadline=None, derandomize=True)
hypothesis.settings.load_profile("few")


@pytest.fixture
def ctrl_c():
    """Return a function that has Ctrl-C pressed after some seconds, whatever the main thread is doing then."""
    timers, handler = [], signal.signal(signal.SIGINT, signal.default_int_handler)

    def press(seconds):
        timers.append(threading.Timer(seconds, _thread.interrupt_main))
        timers[-1].start()

    yield press
    for timer in timers:
        timer.cancel()
        timer.join()
    signal.signal(signal.SIGINT, handler)
