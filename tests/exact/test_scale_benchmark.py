"""The scale benchmark: time is booked to the phase that spent it, and what has a row is not done again."""

import pandas as pd
import pytest

from benchmarks import scale as benchmark
from benchmarks.solves import PHASES, phases
from mamttsp.options import Progress


def _step(time, phase):
    return Progress(time, None, None, None, 0, phase, 0)


def test_a_phase_is_charged_up_to_the_step_that_ends_it():
    steps = [_step(1.0, "heuristic"), _step(3.0, "prices"), _step(3.5, "heuristic"), _step(7.0, "prices")]
    spent = phases(steps)
    assert spent["rounds"] == 2
    assert (spent["heuristic_s"], spent["prices_s"], spent["settle_s"]) == (1.5, 5.5, 0.0)


def test_what_has_a_row_is_not_run_again(tmp_path):
    whole = benchmark.runs_left([], [0, 1], 5.0)
    pd.DataFrame([dict(zip(benchmark.KEY, arguments)) for arguments in whole[:3]]).to_csv(tmp_path / "rows.csv")
    rows = pd.read_csv(tmp_path / "rows.csv").to_dict("records")
    assert len(whole) == 2 * len(benchmark.SIZES) and benchmark.runs_left(rows, [0, 1], 5.0) == whole[3:]
    assert benchmark.runs_left(rows, [0], 6.0) != []  # another limit is another run


def test_a_row_holds_what_the_solve_proved():
    row = benchmark.run(5, 2, 150, 4, 0, 30.0)
    assert row["status"] == "optimal" and row["bound"] <= row["objective"] and row["gap_percent"] <= 0.01
    spent = sum(row[f"{phase}_s"] for phase in PHASES)
    assert spent == pytest.approx(row["solve_time_s"], abs=0.2)
