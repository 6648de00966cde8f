"""The benchmark script: a row for each setting, none run twice, and a table of them."""

import csv
import subprocess
import sys
from pathlib import Path

SCRIPT = Path(__file__).parents[2] / "benchmarks" / "exact.py"


def _run(results):
    arguments = ["--sizes", "5", "--indices", "0", "--results", results, "--time-limit", "20"]
    done = subprocess.run([sys.executable, SCRIPT, *arguments], capture_output=True, text=True, check=True)
    return done.stdout, results.read_text()


def test_rows_are_appended_once_and_tabled(tmp_path):
    results = tmp_path / "rows.csv"
    table, written = _run(results)
    rows = list(csv.DictReader(written.splitlines()))
    settings = [(row["total_window"], row["agents"]) for row in rows]
    assert settings == [("20", "1"), ("40", "1"), ("60", "1"), ("40", "2"), ("40", "3"), ("40", "4"), ("40", "5")]
    assert all(row["status"] == "optimal" and float(row["gap"]) <= 1e-4 for row in rows)
    assert table.count("\n| 5 |") == 7
    lines = written.splitlines(keepends=True)
    results.write_text("".join(lines[:-1]))  # as if the run had been stopped before its last row
    again, completed = _run(results)
    assert completed.startswith("".join(lines[:-1])) and len(completed.splitlines()) == len(lines)
    assert again.count("\n| 5 |") == 7
