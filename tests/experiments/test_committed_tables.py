"""The committed tables: every setting is there, every line is true, and they are what the committed rows say."""

import re
import shutil
from dataclasses import asdict, replace
from pathlib import Path

import pandas as pd
import pytest

from benchmarks.library import AGENTS, settings
from mamttsp import load
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


def test_of_the_library_each_line_is_of_a_setting_and_none_of_the_paper_s_is_lost():
    beyond = {setting for series in AGENTS for setting in settings(series)}
    names = (f"n{run.n:02}-i{run.index:02}-w{run.total_window}" for run in profile("exact"))
    paper = set(zip(names, (run.agents for run in profile("exact"))))
    lines = pd.read_csv(FOLDER / "instances" / "best_known.csv")
    found = set(zip(lines.name, lines.agents))
    assert len(paper) == 560 and paper <= found <= paper | beyond
    assert lines.solution.notna().all() and len(found) == len(lines)


def test_the_page_says_how_many_settings_of_each_series_have_a_line():
    names, page = pd.read_csv(FOLDER / "instances" / "best_known.csv").name, (FOLDER / "README.md").read_text()
    for series in AGENTS:
        count = f"{names.str.startswith(f'{series}-').sum()} of {len(settings(series))}"
        assert re.search(rf"^\| `{series}-` \|[^|]*\| {count} \|$", page, flags=re.M), f"{series}: {count}"


def test_capacities_lengthen_the_best_tours_as_often_as_the_page_says():
    lines = pd.read_csv(FOLDER / "instances" / "best_known.csv").set_index(["name", "agents"]).objective
    pairs = [(f"loads-n20-i{index:02}-w40", f"n20-i{index:02}-w40") for index in range(10)]
    for loaded, free in pairs:  # the same but for demands and capacities
        targets = [replace(target, demand=0.0) for target in load(loaded).targets]
        assert replace(load(free), targets=targets) == load(free)
    lengthened = sum(lines[loaded, 4] > lines[free, 4] * 1.0001 for loaded, free in pairs)
    page = (FOLDER / "README.md").read_text()
    assert f"with 20 targets they make the best tours longer in {lengthened} of {len(pairs)} instances" in page


def test_the_tables_are_what_the_rows_say(tmp_path):
    for name in ("published.csv", "exact.csv", "reduced.csv", "claims_runs.csv"):
        shutil.copy(FOLDER / name, tmp_path)
    for path in build_tables(tmp_path):
        assert path.read_bytes() == (FOLDER / path.name).read_bytes(), f"{path.name}: run python -m mamttsp tables"


def test_runs_set_aside_are_contradicted_by_tours_that_are_verified():
    runs = pd.read_csv(FOLDER / "contradicted_runs.csv")
    known = runs.merge(_best_known(), on=list(INSTANCE), suffixes=("", "_known"))
    assert len(known) == len(runs) > 0
    assert (known.bound > known.objective_known * (1.0 + 1e-4)).all()
    used = pd.read_csv(FOLDER / "claims_runs.csv", usecols=[*INSTANCE, "method", "modeler", "solver", "date"])
    assert not len(runs.merge(used, on=list(used.columns)))
