"""The benchmark's tables: counts and times of certified runs, and ratios that count each run for what it proves."""

import pandas as pd
import pytest

from benchmarks import certification as benchmark


def _rows(*rows):
    columns = ["n", "index", "total_window", "agents", "route", "status", "solve_time_s", "gap_percent", "memory_mb"]
    table = pd.DataFrame(rows, columns=columns)
    return table.assign(solved=table.status == "optimal")


EXACT = _rows(
    (10, 0, 40, 1, "exact", "optimal", 0.5, 0.005, 300),
    (10, 1, 40, 1, "exact", "optimal", 1.5, 0.010, 400),
    (10, 2, 40, 1, "exact", "feasible", 300.0, 2.0, 500),
    (15, 0, 40, 1, "exact", "optimal", 2.0, 0.0, 300),
)


def test_certified_counts_and_times():
    table = benchmark.certified(EXACT)
    ten = table.loc[(10, 40, 1)]
    assert (ten.runs, ten.certified, ten.median_s, ten.worst_s) == (3, 2, 1.5, 300.0)
    assert (ten.worst_gap_percent, ten.memory_mb) == (2.0, 500)


def test_ratios_are_by_instance_and_leave_out_what_is_not_certified():
    others = _rows(
        (10, 0, 40, 1, "micp/scip", "optimal", 10.0, 0.0, 200),
        (10, 1, 40, 1, "micp/scip", "optimal", 0.75, 0.0, 200),
        (10, 2, 40, 1, "micp/scip", "optimal", 1.0, 0.0, 200),
        (15, 0, 40, 1, "micp/scip", "feasible", 1.0, 50.0, 200),
    )
    table = benchmark.ratios(EXACT, others)
    ten = table.loc[("micp/scip", 10)]
    assert (ten.runs, ten.solved, ten.slower, ten.least_ratio) == (2, 2, 1, 0.5)
    assert ten.median_ratio == pytest.approx((20.0 + 0.5) / 2)
    assert table.loc[("micp/scip", 15)].slower == 0  # the other proved nothing
