"""The benchmark of families: instances as the library's, rows of what was proved, and none is run twice."""

import pandas as pd
import pytest

import mamttsp
from benchmarks import families as benchmark
from mamttsp import Instance, Target


@pytest.mark.parametrize(
    "family, name, agents",
    [
        ("types-n20", "types-n20-i03-w40", None),
        ("loads-n25", "loads-n25-i03-w40", None),
        ("crowded-n20-w60-m3", "crowded-n20-i03-w60", 3),
        ("loose-n15-w75-m2", "loose-n15-i03-w75", 2),
    ],
)
def test_instances_are_made_as_the_librarys(family, name, agents):
    assert benchmark.FAMILIES[family](3) == mamttsp.load(name, n_agents=agents)


def test_capacities_of_two_are_not_enough():
    heavy = benchmark.FAMILIES["loads-n20"](1000)
    assert 2 * heavy.agents[0].capacity < sum(target.demand for target in heavy.targets)


def test_open_at_once_is_a_mean_over_time():
    targets = [Target((0.0, 50.0), ((1.0, 0.0), (2.0, 0.0)), windows) for windows in ([(10, 30)], [(10, 20), (25, 30)])]
    assert benchmark.open_at_once(Instance(targets, 1, (0.0, 0.0), 4.0, 50.0)) == pytest.approx(35 / 20)


def test_what_has_a_row_is_not_run_again(tmp_path):
    families = ("types-n20", "n20-w60-m1")
    whole = benchmark.runs_left([], families, [0, 1], 5.0)
    pd.DataFrame([dict(zip(benchmark.KEY, arguments)) for arguments in whole[:2]]).to_csv(tmp_path / "rows.csv")
    rows = pd.read_csv(tmp_path / "rows.csv").to_dict("records")
    assert len(whole) == 4 and benchmark.runs_left(rows, families, [0, 1], 5.0) == whole[2:]
    assert len(benchmark.runs_left(rows, families, [0, 1], 6.0)) == len(whole)  # another limit is another run


def test_a_row_holds_what_the_solve_proved_and_the_table_counts_it():
    row = benchmark.run("loose-n10-w37-m2", 0, 60.0)
    assert row["status"] == "optimal" and row["bound"] <= row["objective"] and row["gap_percent"] <= 0.01
    rows = [row, row | {"seed": 1, "status": "feasible", "solve_time_s": row["solve_time_s"] + 2.0}]
    found = benchmark.summary(rows).iloc[0]
    assert (found.runs, found.decided) == (2, 1) and found.worst_s == row["solve_time_s"] + 2.0
    assert any("feasible" in line for line in benchmark.table([each | {"cpu": "a laptop", "jobs": 1} for each in rows]))
