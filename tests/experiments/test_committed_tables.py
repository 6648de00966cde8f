"""The committed tables: every setting is there, every line is true, and they are what the committed rows say."""

import shutil
from dataclasses import asdict
from pathlib import Path

import pandas as pd
import pytest

from mamttsp.experiments import profile
from mamttsp.experiments.build_tables import build_tables
from mamttsp.experiments.campaigns.rows import INSTANCE
from mamttsp.experiments.summaries.best_known import verify
from mamttsp.generate import PAPER_SIZES

FOLDER = Path(__file__).parents[2] / "paper_results"


def _best_known():
    return pd.read_csv(FOLDER / "best_known.csv")


def test_each_of_the_560_settings_is_there_once():
    wanted = {tuple(asdict(run)[name] for name in INSTANCE) for run in profile("exact")}
    found = list(_best_known()[INSTANCE].itertuples(index=False, name=None))
    assert len(found) == len(wanted) == 560 and set(found) == wanted


@pytest.mark.parametrize("n", PAPER_SIZES)
def test_every_line_is_true(n):
    lines = _best_known()
    lines = lines[lines.n == n]
    assert len(lines) == 140
    for _, line in lines.iterrows():
        verify(line)


def test_the_tables_are_what_the_rows_say(tmp_path):
    for name in ("published.csv", "exact.csv", "reduced.csv", "claims_runs.csv"):
        shutil.copy(FOLDER / name, tmp_path)
    for path in build_tables(tmp_path):
        assert path.read_bytes() == (FOLDER / path.name).read_bytes(), f"{path.name}: run python -m mamttsp tables"
