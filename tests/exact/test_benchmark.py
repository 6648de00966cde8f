"""The benchmark script: a row for each setting, none run twice, and a table of them."""

import csv
import subprocess
import sys
from pathlib import Path

SCRIPT = Path(__file__).parents[2] / "benchmarks" / "exact.py"
DONE = """n,index,total_window,agents,status,objective,bound,gap,runtime_s,nodes,memory_mb,time_limit,version,machine
5,0,20,1,optimal,1.0,1.0,0.0,0.25,1,100,20.0,0,none
5,0,40,1,feasible,2.0,1.0,0.5,20.0,1,100,20.0,0,none
5,0,60,1,crashed,,,,,,,20.0,0,none
5,0,40,4,optimal,1.0,1.0,0.0,0.75,1,300,20.0,0,none
5,1,40,4,optimal,1.0,1.0,0.00005,0.25,1,200,20.0,0,none
"""


def test_what_has_a_row_is_not_run_again_and_all_rows_are_tabled(tmp_path):
    results = tmp_path / "rows.csv"
    results.write_text(DONE)
    arguments = ["--sizes", "5", "--indices", "0", "--results", results, "--time-limit", "20"]
    done = subprocess.run([sys.executable, SCRIPT, *arguments], capture_output=True, text=True, check=True)
    written = results.read_text()
    assert written.startswith(DONE)
    new = list(csv.DictReader(written.splitlines()))[DONE.count("\n") - 1 :]
    assert [(row["total_window"], row["agents"]) for row in new] == [("40", "2"), ("40", "3"), ("40", "5")]
    assert all(row["status"] == "optimal" and float(row["gap"]) <= 1e-4 and row["machine"] for row in new)
    assert done.stdout.count("\n| 5 |") == 7
    assert "| 5 | 40 | 4 | 2 | 2 | 0.50 | 0.75 | 0.005 | 300 |" in done.stdout
    assert "| 5 | 60 | 1 | 1 | 0 | - | - | - | - |" in done.stdout
