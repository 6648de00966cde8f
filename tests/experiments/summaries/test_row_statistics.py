"""Statistics of rows against numbers computed by hand."""

import math

import numpy as np
import pandas as pd
import pytest

from mamttsp.experiments import Run
from mamttsp.experiments.summaries.row_statistics import (
    by_setting,
    conditions,
    of_runs,
    read_table,
    side_by_side,
    true_gaps,
)
from tests.experiments.made_up_rows import EXACT, crashed, solved, stopped, write_rows

RUNS = [Run(5, index, 40, 1, "micp", "pyomo", "scip", 60) for index in (0, 1)]


@pytest.fixture
def table(tmp_path):
    """Return what turns rows into the table that the statistics start from."""
    return lambda *rows: read_table(write_rows(tmp_path / "rows.csv", rows))


def _only(table):
    assert len(table) == 1
    return table.iloc[0]


def test_means_and_shifted_geometric_means_with_the_limit_for_what_was_not_proved(table):
    rows = table(solved(3.0), stopped(100.0, 80.0, index=1))
    found = _only(by_setting(rows, RUNS))
    assert (found.runs, found.rows, found.solved, found.no_tours) == (2, 2, 1, 0)
    assert found.runtime_s == pytest.approx((3 + 60) / 2)
    assert found.gap_percent == pytest.approx((0 + 20) / 2)
    assert found.runtime_geometric_s == pytest.approx(math.sqrt(4 * 61) - 1)
    assert _only(by_setting(rows, RUNS, shift=10.0)).runtime_geometric_s == pytest.approx(math.sqrt(13 * 70) - 10)


def test_a_setting_with_a_missing_row_has_counts_but_no_means(table):
    found = _only(by_setting(table(solved(3.0)), RUNS))
    assert (found.runs, found.rows, found.solved) == (2, 1, 1)
    assert np.isnan([found.runtime_s, found.gap_percent, found.runtime_geometric_s]).all()


@pytest.mark.parametrize("nothing", [crashed(index=1), stopped(None, 80.0, index=1), stopped(None, None, index=1)])
def test_a_run_without_tours_counts_at_the_limit_and_with_the_whole_gap(table, nothing):
    found = _only(by_setting(table(solved(3.0), nothing), RUNS))
    assert (found.rows, found.solved, found.no_tours) == (2, 1, 1)
    assert (found.runtime_s, found.gap_percent) == (31.5, 50.0)


@pytest.mark.parametrize("bound", [None, 0.0, -3.0])
def test_tours_without_a_useful_bound_count_with_the_whole_gap(table, bound):
    found = _only(by_setting(table(solved(3.0), stopped(100.0, bound, index=1)), RUNS))
    assert (found.no_tours, found.gap_percent) == (0, 50.0)


def test_rows_of_other_runs_do_not_count(table):
    others = [{"solver": "clarabel"}, {"time_limit": 1800}, {"method": "baseline"}, {"index": 2}, {"modeler": "cvxpy"}]
    rows = table(solved(3.0), solved(5.0, index=1), *(solved(40.0, **other) for other in others))
    assert _only(by_setting(rows, RUNS)).runtime_s == 4.0


def test_rows_of_a_list_of_runs_are_found_among_others(table):
    rows = table(solved(3.0), solved(9.0, modeler="cvxpy"), solved(5.0, index=1), solved(1.0, index=2))
    assert of_runs(rows, RUNS).runtime_s.tolist() == [3, 5] and of_runs(rows[:0], RUNS).empty


def test_each_window_number_of_agents_size_and_route_is_a_setting(table):
    runs = [Run(5, 0, 40, 1, "micp", "pyomo", "scip", 60), Run(5, 0, 40, 1, "exact", None, None, 300)]
    runs += [Run(5, 0, 20, 1, "micp", "pyomo", "scip", 60), Run(10, 0, 40, 2, "micp", "pyomo", "scip", 60)]
    found = by_setting(table(solved(3.0), solved(1.0, **EXACT), solved(7.0, n=10, agents=2)), runs).runtime_s
    expected = {(40, 1, 5, "micp/scip"): 3, (40, 1, 5, "exact"): 1, (40, 2, 10, "micp/scip"): 7}
    assert found.dropna().to_dict() == expected and np.isnan(found[20, 1, 5, "micp/scip"])


def test_times_stand_side_by_side_where_every_route_has_a_row(table):
    rows = table(
        *(solved(3.0), solved(1.0, **EXACT)),
        *(stopped(90.0, 80.0, index=1), solved(59.0, index=1, **EXACT)),
        *(solved(4.0, index=2), solved(70.0, index=2, **EXACT)),  # not within the 60 s that the other one had
        solved(5.0, index=3),
    )
    found = side_by_side(rows)
    assert list(found.index) == [(5, 0, 40, 1), (5, 1, 40, 1), (5, 2, 40, 1)]
    assert found["micp/scip"].tolist() == [3.5, math.inf, 4.5]
    assert found["exact"].tolist() == [1.5, 59.5, math.inf]


def test_true_gaps_of_incumbents_and_bounds(table):
    certified = [solved(1.0, 200.0, **EXACT | {"index": index}) for index in range(4)]
    certified.append(solved(9.0, 200.01, **EXACT | {"time_limit": 600}))  # proved twice: the better one counts
    exact = table(*certified, stopped(200.0, 150.0, **EXACT | {"index": 4}))
    runs = [(220.0, 150.0), (None, 150.0), (200.0, None), (200.0, -5.0), (200.0, 150.0), (200.0, 150.0)]
    found = true_gaps(table(*(stopped(*run, index=index) for index, run in enumerate(runs))), exact)
    assert found["index"].tolist() == [0, 1, 2, 3]  # no optimum is certified for 4, and 5 has no row
    assert found.incumbent_percent.tolist() == pytest.approx([10, math.nan, 0, 0], nan_ok=True)
    assert found.bound_percent.tolist() == [25, 25, 100, 100]


def test_the_conditions_name_solver_limit_threads_and_machine(table):
    assert conditions(table(solved(1.0))) == "scip 10.0, limit 60 s, threads 1, a laptop"
    assert conditions(table(solved(1.0, time_limit=None))) == "scip 10.0, threads 1, a laptop"
    several = conditions(table(solved(1.0), solved(1.0, **EXACT), crashed(index=1, solver_version=None, threads=None)))
    assert several == "mamttsp exact and scip 10.0, limit 300 and 60 s, threads 1, a laptop"


def test_a_file_without_rows_has_no_means(table):
    rows = table()
    assert by_setting(rows, RUNS)[["rows", "solved"]].to_numpy().tolist() == [[0, 0]]
    assert side_by_side(rows).empty and true_gaps(rows, rows).empty and conditions(rows) == "no rows"
    assert side_by_side(pd.concat([rows, rows])).empty
