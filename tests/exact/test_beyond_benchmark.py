"""The benchmark beyond the paper: instances as the library's, rows of what was proved, and none is run twice."""

import pandas as pd

import mamttsp
from benchmarks import beyond as benchmark
from mamttsp.library import beyond_the_paper, make


def test_instances_are_made_as_the_librarys():
    for series, n in benchmark.FAMILIES:
        assert make(beyond_the_paper(series, n, 3)) == mamttsp.load(f"{series}-n{n}-i03-w40")
    heavy = make(beyond_the_paper("loads", 20, 1000))
    assert 2 * heavy.agents[0].capacity < sum(target.demand for target in heavy.targets)


def test_what_has_a_row_is_not_run_again(tmp_path):
    whole = benchmark.runs_left([], [0, 1], 5.0)
    pd.DataFrame([dict(zip(benchmark.KEY, arguments)) for arguments in whole[:2]]).to_csv(tmp_path / "rows.csv")
    rows = pd.read_csv(tmp_path / "rows.csv").to_dict("records")
    assert len(whole) == 2 * len(benchmark.FAMILIES) and benchmark.runs_left(rows, [0, 1], 5.0) == whole[2:]
    assert len(benchmark.runs_left(rows, [0, 1], 6.0)) == len(whole)  # another limit is another run


def test_a_row_holds_what_the_solve_proved_and_the_table_counts_it():
    row = benchmark.run("types", 10, 0, 60.0)
    assert row["status"] == "optimal" and row["bound"] <= row["objective"] and row["gap_percent"] <= 0.01
    rows = [row, row | {"seed": 1, "status": "feasible", "solve_time_s": row["solve_time_s"] + 2.0}]
    found = benchmark.summary(rows).iloc[0]
    assert (found.runs, found.decided) == (2, 1) and found.worst_s == row["solve_time_s"] + 2.0
    assert any("feasible" in line for line in benchmark.table([each | {"cpu": "a laptop"} for each in rows]))
