"""The best that is known of a setting: the least length, the best bound, who found them, and nothing that is false."""

import json

import pandas as pd
import pytest

from mamttsp import InputError, TourError, paper_instance, solve
from mamttsp.experiments import tours_of
from mamttsp.experiments.summaries.best_known import COLUMNS, best_known, verify
from tests.experiments.synthetic import route, table

_EXACT, _MICP, _BASELINE = (
    route(5, 0, 20, 1, *method) for method in (("exact",), ("micp", "scip"), ("baseline", "scip"))
)


@pytest.fixture(scope="module")
def answer():
    solution = solve(paper_instance(5, 0, 20, 1))
    tours = json.dumps([tour.to_dict() for tour in solution.tours])
    return {"objective": solution.objective, "bound": solution.bound, "tours": tours}


def test_the_shortest_tours_and_the_best_bound_are_taken_from_different_routes(tmp_path):
    rows = table(
        tmp_path / "rows.csv",
        (_MICP, {"objective": 110.0, "bound": 99.0, "tours": "[1]"}),
        (_BASELINE, {"objective": 100.0, "bound": 50.0, "tours": "[2]"}),
        (_EXACT, {"objective": 100.00000001, "bound": 98.0, "tours": "[3]"}),
        (route(10, 3, 40, 2, "micp", "scip"), {"status": "unknown", "bound": 7.0}),
    )
    first, second = best_known(rows).to_dict("records")
    assert tuple(first) == COLUMNS
    assert (first["objective"], first["objective_by"], first["tours"]) == (100.0, "baseline/scip exact", "[2]")
    assert (first["bound"], first["bound_by"], first["gap_percent"]) == (99.0, "micp/scip", pytest.approx(1.0))
    assert [second[name] for name in ("n", "index", "total_window", "agents")] == [10, 3, 40, 2]
    assert (second["bound"], second["bound_by"], second["objective_by"]) == (7.0, "micp/scip", "")
    assert pd.isna(second["objective"]) and pd.isna(second["gap_percent"]) and second["tours"] == "[]"


def test_a_bound_above_the_tours_is_cut_within_tolerance_and_refused_beyond(tmp_path):
    rows = table(tmp_path / "rows.csv", (_MICP, {"objective": 100.0, "bound": 100.001}))
    assert best_known(rows).bound.tolist() == [100.0]
    contradiction = table(tmp_path / "more.csv", (_MICP, {"bound": 101.0}), (_EXACT, {"objective": 100.0}))
    with pytest.raises(
        InputError, match="n 5, index 0, .*: the bound 101.0 is above the length 100.0 .micp/scip .* exact"
    ):
        best_known(contradiction)


def test_a_true_line_passes(tmp_path, answer):
    line = best_known(table(tmp_path / "rows.csv", (_EXACT, answer))).iloc[0]
    verify(line)


@pytest.mark.parametrize(
    "change, message",
    [
        (lambda line: {"objective": line["objective"] * (1 - 1e-6)}, "but the tours' length is"),
        (lambda line: {"bound": line["objective"] + 1e-6}, "is not between 0 and the objective"),
        (lambda line: {"bound": float("nan")}, "is not between 0 and the objective"),
        (lambda line: {"gap_percent": 0.5}, "objective and bound say"),
        (lambda line: {"index": 1}, "n 5, index 1, total_window 20, agents 1: "),
        (lambda line: {"tours": "[]"}, "n 5, index 0, total_window 20, agents 1: "),
        (lambda line: {"tours": line["tours"].replace('"time": ', '"time": 1', 1)}, "n 5, index 0"),
    ],
)
def test_a_false_line_is_found(tmp_path, answer, change, message):
    line = best_known(table(tmp_path / "rows.csv", (_EXACT, answer))).iloc[0]
    assert tours_of(line)
    with pytest.raises(TourError, match=message):
        verify(line.to_dict() | change(line))
