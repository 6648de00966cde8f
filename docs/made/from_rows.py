"""Numbers and tables from the rows in paper_results, as Markdown."""

from functools import cache
from pathlib import Path

import certification
import pandas as pd
import scale

from mamttsp.experiments.statistics import read_table

RESULTS = Path(__file__).parents[2] / "paper_results"


@cache
def exact_rows():
    return read_table(RESULTS / "exact.csv")


@cache
def scale_rows():
    return pd.read_csv(RESULTS / "scale.csv")


def certified():
    """How many of the paper's settings have a proved optimum, such as `560 of 560`."""
    rows = exact_rows()
    return f"{rows.solved.sum()} of {len(rows)}"


def seconds_for_20():
    """The median time in s of a setting with 20 targets."""
    rows = exact_rows()
    return f"{rows[rows.n == 20].solve_time_s.median():.1f}"


def certification_tables():
    return "\n".join(certification.tables(RESULTS))


def reach():
    return "\n".join(scale.table(scale_rows().to_dict("records")))


def reach_in_words():
    """A sentence for each number of targets beyond the paper's: how many are certified, how soon, or what is left."""
    return "\n".join(_reach_of(n, rows) for n, rows in scale_rows().groupby("n"))


def _reach_of(n, rows):
    solved, left = rows[rows.status == "optimal"], rows[rows.status != "optimal"]
    line = f"- **{n} targets**: {len(solved)} of {len(rows)} instances certified"
    if len(solved):
        line += f", in {solved.solve_time_s.min():.0f} to {solved.solve_time_s.max():.0f} s"
    if len(left):
        line += f"; the others stop at a gap of {left.gap_percent.min():.1f} to {left.gap_percent.max():.1f} %"
    return f"{line}."
