"""The tables' command: both files from the rows of a folder, the same bytes each time, and a line for what is wrong."""

import shutil
from pathlib import Path

import pandas as pd
import pytest

from mamttsp.__main__ import main
from mamttsp.experiments.claims.claim_table import COLUMNS as CLAIMS
from mamttsp.experiments.summaries.best_known import COLUMNS as BEST_KNOWN
from tests.experiments.synthetic import route, table

_RESULTS = Path(__file__).parents[2] / "paper_results"


@pytest.fixture
def folder(tmp_path):
    """Two settings: one that two routes solved, one that nobody did."""
    shutil.copy(_RESULTS / "published.csv", tmp_path)
    solved = {"objective": 100.0, "bound": 100.0, "runtime_s": 1.0, "gap_percent": 0.0}
    table(tmp_path / "exact.csv", (route(5, 0, 40, 1, "exact", time_limit=300.0), solved))
    unsolved = {"status": "unknown"}
    rows = [(route(5, 0, 40, 1, "micp", "scip"), solved), (route(10, 0, 40, 1, "micp", "scip"), unsolved)]
    table(tmp_path / "reduced.csv", *rows)
    table(tmp_path / "claims_runs.csv")
    return tmp_path


def test_both_tables_are_made_again_byte_by_byte(folder, capsys):
    written = [folder / "best_known.csv", folder / "claims.csv"]
    assert main(["tables", "--results", str(folder)]) == 0
    assert capsys.readouterr().out.splitlines() == list(map(str, written))
    before = [path.read_bytes() for path in written]
    assert main(["tables", "--results", str(folder)]) == 0
    assert [path.read_bytes() for path in written] == before
    best, claims = map(pd.read_csv, written)
    assert (tuple(best), tuple(claims)) == (BEST_KNOWN, CLAIMS)
    assert best.objective_by.fillna("").tolist() == ["exact micp/scip", ""]
    assert before[0].decode().splitlines()[1].startswith("5,0,40,1,100,exact micp/scip,100,exact micp/scip,0,")
    assert claims.drop(columns="published").notna().all(axis=None)


@pytest.mark.parametrize(
    "name, message", [("exact.csv", "cannot be read: No such file"), ("published.csv", "cannot be read: No such file")]
)
def test_a_missing_file_is_one_line(folder, capsys, name, message):
    (folder / name).unlink()
    assert main(["tables", "--results", str(folder)]) == 2
    err = capsys.readouterr().err
    assert err.startswith(f"{folder / name}: {message}") and err.count("\n") == 1


def test_a_table_that_cannot_be_written_is_one_line(folder, capsys):
    (folder / "best_known.csv").mkdir()
    assert main(["tables", "--results", str(folder)]) == 2
    assert capsys.readouterr().err == f"{folder / 'best_known.csv'}: cannot be written: Is a directory\n"


def test_every_column_is_explained():
    page = (_RESULTS / "README.md").read_text()
    assert [name for name in (*BEST_KNOWN, *CLAIMS) if f"`{name}`" not in page] == []
