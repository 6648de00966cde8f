"""Rows of campaigns that never ran, as statistics.read_table returns them."""

from dataclasses import asdict

from mamttsp.backends import choose
from mamttsp.experiments import Run
from mamttsp.experiments.summaries.row_statistics import read_table
from tests.experiments.made_up_rows import write_rows


def route(n, index, total_window, agents, method, solver=None, time_limit=60.0):
    """Return the Run of a method: exact without solver, others by the modeler that campaigns take for their solver."""
    modeler = solver and choose(method, None, solver)[0]
    return Run(n, index, total_window, agents, method, modeler, solver, time_limit)


def table(path, *answers):
    """Return the table of (Run, answer's fields) pairs, written to `path` and read back."""
    rows = [asdict(run) | {"status": "optimal", "tours": "[]"} | fields for run, fields in answers]
    return read_table(write_rows(path, rows))
