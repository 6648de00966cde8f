"""Rows of relaxed bounds: one for each setting and method, resumed by key, and joined with certified optima only."""

from pathlib import Path

import pandas as pd
import pytest

from mamttsp import paper_instance
from mamttsp.experiments import read_rows
from mamttsp.experiments.campaigns.relaxed_rows import relaxations
from mamttsp.experiments.campaigns.rows import INSTANCE
from mamttsp.experiments.campaigns.runs import SETTINGS
from mamttsp.experiments.summaries.row_statistics import bound_over_optimum
from mamttsp.relaxation import CONIC_METHODS, relax
from tests.experiments.fakes import indices

COMMITTED = Path(__file__).parents[3] / "paper_results" / "relaxations.csv"


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    path = tmp_path_factory.mktemp("rows") / "relaxations.csv"
    relaxations(path, sizes=(5,), indices=(0,), quiet=True)
    return path


def test_each_setting_has_a_row_of_each_method(path):
    rows = read_rows(path)
    assert len(rows) == len(SETTINGS) * len(CONIC_METHODS) and {row["status"] for row in rows} == {"relaxed"}
    settings = {(float(row["total_window"]), int(row["agents"]), row["method"]) for row in rows}
    assert settings == {(*setting, method) for setting in SETTINGS for method in CONIC_METHODS}


def test_a_row_holds_the_bound_and_where_it_comes_from(path):
    row = next(row for row in read_rows(path) if row["method"] == "micp" and row["agents"] == "3")
    assert float(row["bound"]) == relax(paper_instance(5, 0, 40, 3))
    assert row["solver_version"].startswith("clarabel ") and row["modeler_version"].startswith("cvxpy ")
    assert row["objective"] == row["time_limit"] == "" and row["python"] and row["date"]


def test_started_again_it_does_only_what_is_missing(path, tmp_path):
    lines = path.read_bytes().splitlines(keepends=True)
    part = tmp_path / "part.csv"
    part.write_bytes(b"".join(lines[:-2]))
    relaxations(part, sizes=(5,), indices=(0,), quiet=True)
    again = part.read_bytes().splitlines(keepends=True)
    assert again[:-2] == lines[:-2] and len(again) == len(lines)
    assert [row["bound"] for row in read_rows(part)] == [row["bound"] for row in read_rows(path)]
    assert indices(part) == [0] * len(SETTINGS) * len(CONIC_METHODS)


def test_bounds_are_divided_by_certified_optima_only(path, tmp_path):
    exact = tmp_path / "exact.csv"
    exact.write_text("n,index,total_window,agents,status,objective\n5,0,20,1,optimal,200\n5,0,40,1,feasible,200\n")
    found = bound_over_optimum(path, exact).set_index("method")
    assert list(found["total_window"]) == [20, 20] and list(found["optimum"]) == [200, 200]
    assert found.loc["micp", "ratio"] == pytest.approx(relax(paper_instance(5, 0, 20)) / 200)
    assert found.loc["baseline", "ratio"] == 0


def test_the_committed_rows_are_those_of_today(path):
    key = [*INSTANCE, "method"]
    committed, today = (pd.read_csv(file).set_index(key)["bound"] for file in (COMMITTED, path))
    assert committed.loc[today.index].to_numpy() == pytest.approx(today.to_numpy(), rel=1e-5)


def test_the_committed_rows_are_complete_and_bounds_fall_with_longer_windows():
    rows = pd.read_csv(COMMITTED)
    assert len(rows) == 2 * 560 and not rows.duplicated([*INSTANCE, "method"]).any()
    assert (rows[rows["method"] == "baseline"]["bound"] == 0).all()
    one_agent = rows[(rows["method"] == "micp") & (rows["agents"] == 1)]
    by_window = one_agent.pivot_table(index=["n", "index"], columns="total_window", values="bound")
    assert len(by_window) == 80 and (by_window.diff(axis=1).iloc[:, 1:] < 1e-3).all(axis=None)
