"""The paper's published numbers, as digitised from its Figures 2 and 3."""

import pandas as pd

from ..validation import InputError

COLUMNS = ("figure", "total_window_s", "agents", "targets", "formulation", "runtime_s", "gap_percent")
#: under what the paper's numbers were measured, as in its Section V-A
CONDITIONS = "Gurobi 10.0.3, limit 1800 s, Intel i7-7700HQ"


def read_published(path):
    """Return the published numbers as a DataFrame; runtime_s and gap_percent stay texts, for their `<` and `~`.

    InputError: no such file, or other columns.
    """
    try:
        rows = pd.read_csv(path, dtype={"runtime_s": str, "gap_percent": str})
    except (OSError, UnicodeDecodeError, pd.errors.ParserError, pd.errors.EmptyDataError) as error:
        raise InputError(f"{path}: cannot be read: {getattr(error, 'strerror', None) or error}") from error
    if tuple(rows.columns) != COLUMNS:
        raise InputError(f"{path}: expected the columns {', '.join(COLUMNS)}, found {', '.join(rows.columns)}")
    return rows
