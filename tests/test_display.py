"""What is shown and recorded of a running solve, on a terminal, in a notebook and in a log."""

import io
import sys
import types

import IPython.display
import pytest

from mamttsp import Progress, solve
from mamttsp.display import NotebookLine, ProgressLine, ProgressLog, Trace, format_progress, progress_display
from tests.examples import instance, still

STEPS = [
    Progress(0.25, None, 150.0, None, 0, "multipliers", 0),
    Progress(1.5, 200.0, 150.0, 0.25, 1234, "routes", 56),
]
SCIP = Progress(2.0, 200.0, None, None, None, "scip")


def test_columns_are_in_the_line_where_there_are_any():
    assert format_progress(STEPS[1]).split("  ")[-3:] == ["nodes 1234", "columns 56", "routes"]
    assert "columns" not in format_progress(SCIP)


def test_a_trace_records_and_hands_on():
    seen = []
    trace = Trace(then=seen.append)
    for step in STEPS:
        trace(step)
    assert list(trace) == trace.steps == seen == STEPS


def test_a_trace_that_is_still_empty_is_a_callback_all_the_same():
    assert bool(Trace())  # back ends ask `if progress:`


def test_a_trace_records_a_solve():
    trace = Trace()
    solution = solve(instance(still(10, 0), still(0, 10)), progress=trace)
    assert trace.steps[-1].objective == pytest.approx(solution.objective)
    assert trace.steps[-1].bound == solution.bound


def test_the_log_is_a_table():
    trace = Trace()
    for step in (*STEPS, SCIP):
        trace(step)
    lines = trace.table().splitlines()
    assert [line.split() for line in lines] == [
        ["phase", "nodes", "columns", "incumbent", "bound", "gap", "time"],
        ["multipliers", "0", "0", "-", "150.0000", "-", "0.2", "s"],
        ["routes", "1234", "56", "200.0000", "150.0000", "25.0000", "%", "1.5", "s"],
        ["scip", "-", "-", "200.0000", "-", "-", "2.0", "s"],
    ]
    assert len({len(line) for line in lines}) == 1


def test_without_times_the_same_run_gives_the_same_text():
    fast, slow = Trace(), Trace()
    for time, trace in ((1.0, fast), (100.0, slow)):
        trace(Progress(time, 200.0, 150.0, 0.25, 1, "routes", 2))
    assert fast.table(times=False) == slow.table(times=False) and fast.table() != slow.table()


def test_the_log_prints_what_the_trace_tells():
    stream, trace = io.StringIO(), Trace()
    log = ProgressLog(stream)
    for step in STEPS:
        trace(step)
        log(step)
    assert stream.getvalue() == trace.table() + "\n"


def test_the_log_goes_to_standard_output_by_itself(capsys):
    ProgressLog()(STEPS[0])
    assert capsys.readouterr().out.splitlines()[1].startswith("multipliers")


def test_outside_a_notebook_the_display_is_a_line_on_the_stream(monkeypatch):
    stream = io.StringIO()
    for shell in (None, object()):  # plain Python, and IPython on a terminal
        monkeypatch.setitem(sys.modules, "IPython", types.SimpleNamespace(get_ipython=lambda: shell))
        display = progress_display(stream)
        assert isinstance(display, ProgressLine) and display.stream is stream
    monkeypatch.delitem(sys.modules, "IPython")
    assert isinstance(progress_display(stream), ProgressLine)


def test_in_a_notebook_the_display_is_a_line_under_the_cell(monkeypatch):
    shell = types.SimpleNamespace(kernel="a kernel")
    monkeypatch.setitem(sys.modules, "IPython", types.SimpleNamespace(get_ipython=lambda: shell))
    assert isinstance(progress_display(), NotebookLine)


@pytest.fixture
def shown(monkeypatch):
    """The texts that a notebook would show one after the other in one place."""
    texts = []
    handle = types.SimpleNamespace(update=lambda data, raw: texts.append(data["text/plain"]))

    def display(data, raw, display_id):
        assert raw and display_id and not texts
        texts.append(data["text/plain"])
        return handle

    monkeypatch.setattr(IPython.display, "display", display)
    return texts


def test_a_notebook_shows_one_line_and_empties_it(shown):
    with NotebookLine() as line:
        for step in STEPS:
            line(step)
    assert shown == [format_progress(STEPS[0]), format_progress(STEPS[1]), ""]


def test_a_notebook_shows_nothing_of_a_solve_that_reports_nothing(shown):
    with NotebookLine():
        pass
    assert shown == []
