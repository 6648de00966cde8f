"""The tables that are made of rows: best_known.csv and claims.csv, in the folder of the rows; and what is best known of
the library's instances, in a folder beside them."""

from pathlib import Path

import pandas as pd

from ..validation import InputError
from .campaigns.rows import line_of, text_of
from .claims.claim_table import claim_table
from .summaries.best_known import best_known
from .summaries.best_solutions import of_rows, update
from .summaries.published import read_published
from .summaries.row_statistics import read_table


def build_tables(folder):
    """Write both tables into `folder`, from its published.csv and the rows in it, and yield their paths.

    The rows: exact.csv, reduced.csv and claims_runs.csv.

    Where there is a folder `instances`, what the rows know better is taken into its own best_known.csv.
    InputError: a file is missing or has other columns, rows contradict each other, or a table cannot be written.
    """
    folder = Path(folder)
    names = ("exact", "reduced", "claims_runs")
    exact, reduced, longer = (read_table(folder / f"{name}.csv") for name in names)
    best = best_known(pd.concat([exact, reduced, longer], ignore_index=True))
    yield _write(best, folder / "best_known.csv")
    published = read_published(folder / "published.csv")
    yield _write(claim_table(published, reduced, longer, exact), folder / "claims.csv")
    if (folder / "instances").is_dir():
        yield update(folder / "instances", of_rows(best))


def _write(table, path):
    lines = [[None if pd.isna(value) else text_of(value) for value in line] for line in table.itertuples(index=False)]
    try:
        path.write_bytes(b"".join(line_of(line) for line in [table.columns, *lines]))
    except OSError as error:
        raise InputError(f"{path}: cannot be written: {error.strerror}") from error
    return path
