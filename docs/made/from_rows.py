"""Numbers and tables from the rows in paper_results, as Markdown."""

import re
from functools import cache
from pathlib import Path

import certification
import pandas as pd
import scale

from mamttsp.experiments.summaries.row_statistics import read_table

RESULTS = Path(__file__).parents[2] / "paper_results"


@cache
def exact_rows():
    return read_table(RESULTS / "exact.csv")


@cache
def scale_rows():
    return pd.read_csv(RESULTS / "scale.csv")


def certified():
    """How many problems by the paper's recipe have a proved optimum, such as `560 of 560`."""
    rows = exact_rows()
    return f"{rows.solved.sum()} of {len(rows)}"


def time_for_20():
    """The median time of a setting with 20 targets, such as `3.9 s`."""
    rows = exact_rows()
    return f"{rows[rows.n == 20].solve_time_s.median():.1f}\N{NO-BREAK SPACE}s"


def certification_tables():
    """The tables of benchmarks/certification.py."""
    return _in_words(certification.tables(RESULTS))


def reach():
    """The tables of benchmarks/scale.py."""
    return _in_words(scale.table(scale_rows().to_dict("records")))


def _in_words(parts):
    """Return Markdown whose tables have heads of words and units in place of the columns' names in files."""
    lines = "\n".join(parts).splitlines()
    heads = [k - 1 for k, line in enumerate(lines) if line.startswith(("|-", "|:"))]
    for k in heads:
        for end, unit in (("s", "s"), ("mb", "MB"), ("percent", "%")):
            lines[k] = re.sub(rf"_{end}\b", f" ({unit})", lines[k])
        lines[k] = lines[k].replace("_", " ")
    return "\n".join(lines)


def reach_in_words():
    """A sentence for each number of targets beyond the paper's: how many are certified, how soon, or what is left."""
    return "\n".join(_reach_of(n, rows) for n, rows in scale_rows().groupby("n"))


def _reach_of(n, rows):
    solved, left = rows[rows.status == "optimal"], rows[rows.status != "optimal"]
    line = f"- **{n} targets**: {len(solved) or 'none'} of {len(rows)} instances certified"
    if len(solved):
        line += f", in {_range(solved.solve_time_s, '.0f')} s"
    if len(left):
        line += f"; a gap of {_range(left.gap_percent, '.1f')} % is left after {left.time_limit.iloc[0]:.0f} s"
        line += " in the others" if len(solved) else ""
    return f"{line}."


def _range(values, digits):
    return " to ".join(dict.fromkeys(format(value, digits) for value in (values.min(), values.max())))
