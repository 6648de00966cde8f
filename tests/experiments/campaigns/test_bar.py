"""The bar of a campaign, on a terminal and in a log file."""

import io

import pytest

from mamttsp.experiments.campaigns.bar import campaign_bar


@pytest.fixture
def clock(monkeypatch):
    """Seconds that a test sets."""
    now = [0.0]
    monkeypatch.setattr("mamttsp.experiments.campaigns.bar.time.monotonic", lambda: now[0])
    return now


class _Terminal(io.StringIO):
    def isatty(self):
        return True


def test_in_a_file_there_is_a_line_once_a_minute_and_one_at_the_end(clock):
    stream = io.StringIO()
    with campaign_bar(420, 12, stream=stream) as bar:
        for _ in range(200):
            clock[0] += 1.0
            bar.set_postfix_str("2 running")
            bar.update()
    assert stream.getvalue().splitlines() == [
        "71 of 420 runs after 1:00 min, 2 running",
        "131 of 420 runs after 2:00 min, 2 running",
        "191 of 420 runs after 3:00 min, 2 running",
        "212 of 420 runs after 3:20 min",
    ]
    assert "\r" not in stream.getvalue()


def test_on_a_terminal_one_line_is_written_over():
    stream = _Terminal()
    with campaign_bar(3, 1, stream=stream) as bar:
        bar.update()
    assert "2/3" in stream.getvalue() and "\r" in stream.getvalue() and stream.getvalue().count("\n") == 1


@pytest.mark.parametrize("stream", [io.StringIO(), _Terminal()])
def test_quiet_is_quiet(stream):
    with campaign_bar(3, 1, quiet=True, stream=stream) as bar:
        bar.update()
    assert stream.getvalue() == ""
