"""The paper's published numbers, and the page that explains the columns."""

import re
from pathlib import Path

import pandas

from mamttsp.experiments.campaigns.rows import COLUMNS
from mamttsp.experiments.campaigns.runs import SETTINGS
from mamttsp.generate import PAPER_SIZES

FOLDER = Path(__file__).parents[3] / "paper_results"


def test_each_bar_of_the_two_figures_is_there_once_and_is_a_number():
    rows = pandas.read_csv(FOLDER / "published.csv", dtype={"runtime_s": str, "gap_percent": str})
    keys = list(rows[["total_window_s", "agents", "targets", "formulation"]].itertuples(index=False, name=None))
    bars = [(*setting, n, method) for setting in SETTINGS for n in PAPER_SIZES for method in ("micp", "baseline")]
    assert sorted(keys) == sorted(bars)
    assert rows.groupby("figure").size().to_dict() == dict.fromkeys(("2a", "2b", "2c", "3a", "3b", "3c", "3d"), 8)
    assert rows.runtime_s.str.fullmatch(r"[<~]?\d+(\.\d+)?").all()
    assert rows.gap_percent.str.fullmatch(r"~?\d+(\.\d+)?").all()
    limit = rows[rows.runtime_s == "1800"]
    assert (limit.gap_percent.astype(float) > 0).all()  # what ran into the limit has a gap left


def test_every_column_is_explained():
    page = (FOLDER / "README.md").read_text()
    explained = set(re.findall(r"`(\w+)`", page))
    published = pandas.read_csv(FOLDER / "published.csv").columns
    assert set(COLUMNS) <= explained and set(published) <= explained
