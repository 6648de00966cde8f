"""Published numbers to compare with: the paper's Figures 2 and 3, digitised, and a table of its predecessor."""

import pandas as pd

from ...validation import InputError

COLUMNS = ("figure", "total_window_s", "agents", "targets", "formulation", "runtime_s", "gap_percent")
PREDECESSOR = ("total_window", "n", "method", "ratio")
#: under what the paper's numbers were measured, as in its Section V-A
CONDITIONS = "Gurobi 10.0.3, limit 1800 s, Intel i7-7700HQ"


def read_published(path):
    """Return the paper's numbers as a DataFrame; runtime_s and gap_percent stay texts, for their `<` and `~`.

    InputError: no such file, or other columns.
    """
    return _read(path, COLUMNS, {"runtime_s": str, "gap_percent": str})


def read_predecessor(path):
    """Return the single-agent predecessor's relaxed bounds over best bounds as a DataFrame; InputError as above."""
    return _read(path, PREDECESSOR, {"method": str})


def _read(path, columns, types):
    try:
        rows = pd.read_csv(path, dtype=types)
    except (OSError, UnicodeDecodeError, pd.errors.ParserError, pd.errors.EmptyDataError) as error:
        raise InputError(f"{path}: cannot be read: {getattr(error, 'strerror', None) or error}") from error
    if tuple(rows.columns) != columns:
        raise InputError(f"{path}: expected the columns {', '.join(columns)}, found {', '.join(rows.columns)}")
    return rows
