"""All figures of the experiments, from the rows in a folder such as paper_results/."""

from pathlib import Path

import matplotlib.pyplot as plt

from ..figures.style import save
from ..validation import InputError
from .campaigns.runs import profile
from .sheets import (
    comparison_sheets,
    idle_agent_sheet,
    open_sheets,
    our_sheets,
    published_sheets,
    relaxation_sheet,
    true_gaps_sheet,
)
from .summaries.published import read_predecessor, read_published
from .summaries.row_statistics import bound_over_optimum, of_runs, read_table


def build(results, out):
    """Draw every figure of the experiments into the folder `out`, and yield the path of each, without its ending.

    results: folder with published.csv, exact.csv, reduced.csv and claims_runs.csv. Figures whose rows are there are
    drawn before a missing file is reported. InputError: a file is missing or has other columns, or a figure cannot be
    written.
    """
    results, out = Path(results), Path(out)
    for name, ax in _figures(results):
        try:
            save(ax, out / name, dpi=300)
        except OSError as error:
            raise InputError(f"{out / name}: cannot be written: {error.strerror}") from error
        finally:
            plt.close(ax.figure)
        yield out / name


def _figures(results):
    yield from published_sheets(read_published(results / "published.csv"))
    exact = read_table(results / "exact.csv")
    yield "paper-fig-1", idle_agent_sheet(exact, results / "exact.csv")
    reduced = of_runs(read_table(results / "reduced.csv"), profile("reduced"))
    yield from our_sheets(reduced)
    yield from open_sheets(reduced, read_table(results / "claims_runs.csv"))
    yield from comparison_sheets(reduced, exact)
    yield "experiments-true-gaps", true_gaps_sheet(reduced, exact)
    if (path := results / "relaxations.csv").exists():
        known = bound_over_optimum(path, results / "exact.csv")
        predecessor = read_predecessor(results / "predecessor.csv")
        yield "experiments-relaxations", relaxation_sheet(read_table(path), known, predecessor)
