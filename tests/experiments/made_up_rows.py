"""Results files with rows that nobody ran, to compute on by hand and to draw."""

from mamttsp.experiments.campaigns.rows import COLUMNS, line_of, text_of

_SAME = {"n": 5, "index": 0, "total_window": 40, "agents": 1, "method": "micp", "modeler": "pyomo", "solver": "scip"}
_SAME |= {"time_limit": 60, "tours": "[]", "solver_version": "scip 10.0", "threads": 1, "cpu": "a laptop"}
EXACT = {"method": "exact", "modeler": None, "solver": None, "time_limit": 300, "solver_version": "mamttsp exact"}


def solved(seconds, objective=100.0, **fields):
    """Return a row of a run that was proved after some seconds."""
    return _SAME | _answer("optimal", objective, objective, seconds) | fields


def stopped(objective, bound, **fields):
    """Return a row of a run that its limit ended, with the solver at 59 s; objective None: without tours."""
    return _SAME | _answer("unknown" if objective is None else "feasible", objective, bound, 59.0) | fields


def crashed(**fields):
    """Return a row of a run whose process died."""
    return _SAME | {"status": "crashed", "message": "SIGABRT", "tours": None} | fields


def write_rows(path, rows):
    """Write a results file and return its path."""
    lines = [COLUMNS, *([text_of(row.get(name)) for name in COLUMNS] for row in rows)]
    path.write_bytes(b"".join(map(line_of, lines)))
    return path


def _answer(status, objective, bound, seconds):
    known = objective is not None and bound is not None
    gap = (objective - bound) / objective if known else None
    numbers = {"objective": objective, "bound": bound, "gap": gap, "gap_percent": 100 * gap if known else None}
    return numbers | {"status": status, "runtime_s": seconds, "solve_time_s": seconds + 0.5}
