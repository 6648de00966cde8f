"""Solution: its gap, its file, and files that are not one."""

import dataclasses
import json
import math
import re

import pytest

from mamttsp import InputError, PaperSolution, Solution, Tour, Visit
from mamttsp.solution import STATUSES, known_length, relative_gap

SOLUTION = Solution(
    status="feasible",
    objective=123.5,
    bound=100.25,
    runtime=1.5,
    tours=(Tour((Visit(0, 12.5, (3.0, 4.0)),), 40.0), Tour((), 0.0)),
    method="micp",
    solver="scip 10.0",
    modeler="pyomo",
    build_time=0.25,
    nodes=17,
    subtour_cuts=1,
)


@pytest.mark.parametrize(
    "objective, bound, gap",
    [
        (100.0, 75.0, 0.25),
        (100.0, 100.0, 0.0),
        (100.0, 100.000001, 0.0),
        (None, 1.0, None),
        (1.0, None, None),
        (0.0, 0.0, 0.0),
    ],
)
def test_the_gap_is_a_share_of_the_objective(objective, bound, gap):
    assert relative_gap(objective, bound) == gap


def test_a_solution_of_types_survives_its_file_and_numbers_them(tmp_path):
    tours = (Tour(SOLUTION.tours[0].visits, 40.0, agent=1), Tour((), 0.0, agent=0))
    typed = dataclasses.replace(SOLUTION, tours=tours)
    typed.write(tmp_path / "solution.json")
    data = json.loads((tmp_path / "solution.json").read_text())
    assert data["version"] == 2 and [tour["agent"] for tour in data["tours"]] == [1, 0]
    assert Solution.read(tmp_path / "solution.json") == typed


def test_a_solution_survives_its_file(tmp_path):
    SOLUTION.write(tmp_path / "solution.json")
    assert Solution.read(tmp_path / "solution.json") == SOLUTION


def test_an_infeasible_solution_has_nulls_and_no_gap(tmp_path):
    nothing = Solution("infeasible", None, None, 0.5, (), "exact", "mamttsp 0.1")
    nothing.write(tmp_path / "solution.json")
    data = json.loads((tmp_path / "solution.json").read_text())
    assert data["objective"] is data["bound"] is data["gap"] is None and data["tours"] == []
    assert Solution.read(tmp_path / "solution.json") == nothing


def test_the_file_has_the_fields_of_the_format():
    data = SOLUTION.to_dict()
    assert data["format"] == "mamttsp-solution" and data["version"] == 1
    assert all("agent" not in tour for tour in data["tours"])
    assert data["runtime_s"] == 1.5 and data["gap"] == pytest.approx(23.25 / 123.5)
    assert data["tours"][0] == {"visits": [{"target": 0, "time": 12.5, "position": [3.0, 4.0]}], "return_time": 40.0}


def test_statuses():
    assert STATUSES == ("optimal", "feasible", "infeasible", "unknown")


@pytest.mark.parametrize(
    "change, message",
    [
        ({"format": "mamttsp-instance"}, 'format: expected "mamttsp-solution", found "mamttsp-instance"'),
        ({"version": 3}, "version: expected 1 or 2, found 3"),
        ({"version": 2}, "tours[0].agent: missing; version 2 numbers the type"),
        ({"status": "great"}, "status: expected one of optimal, feasible, infeasible, unknown"),
        ({"objective": "low"}, "objective: expected a finite number or null"),
        ({"bound": True}, "bound: expected a finite number or null"),
        ({"objective": math.inf}, "objective: expected a finite number or null"),
        ({"tours": {}}, "tours: expected a list"),
        ({"tours": [{"agent": -1, "visits": [], "return_time": 0.0}]}, "tours[0].agent: expected a whole number"),
        ({"tours": [{"agent": True, "visits": [], "return_time": 0.0}]}, "tours[0].agent: expected a whole number"),
        ({"tours": [None]}, "tours[0]: expected visits"),
    ],
)
def test_a_bad_field_is_named(change, message):
    with pytest.raises(InputError) as caught:
        Solution.from_dict(SOLUTION.to_dict() | change)
    assert str(caught.value).startswith(message)


@pytest.mark.parametrize("field", ["status", "method", "solver", "objective", "bound", "runtime_s", "tours"])
def test_a_missing_field_is_named(field):
    data = SOLUTION.to_dict()
    del data[field]
    with pytest.raises(InputError, match=f"^{field}: missing"):
        Solution.from_dict(data)


@pytest.mark.parametrize("unknown", [None, math.inf, -math.inf, math.nan, 1e20, -1e20])
def test_what_solvers_use_for_no_value_is_none(unknown):
    assert known_length(unknown) is None


def test_a_length_is_never_below_zero():
    assert known_length(-1e-9) == 0.0 and known_length(3) == 3.0


def test_a_solution_prints_as_a_table():
    lines = str(SOLUTION).splitlines()
    assert lines[0].split() == ["status", "feasible"] and lines[5].split() == ["gap", "18.8259", "%"]
    assert lines[-2:] == ["tour 0        target 0 at 12.50 s; back at 40.00 s", "tour 1        stays at the depot"]


def test_a_notebook_shows_the_same_rows():
    html = SOLUTION._repr_html_()
    rows = re.findall("<tr><th>(.*?)</th><td>(.*?)</td></tr>", html)
    assert [f"{name:<13} {value}" for name, value in rows] == str(SOLUTION).splitlines()


def test_html_in_a_name_is_text():
    assert "&lt;b&gt;" in dataclasses.replace(SOLUTION, solver="<b>")._repr_html_()


def test_the_cycles_of_a_plain_model_are_in_its_table():
    claim = PaperSolution("optimal", 20.0, 20.0, 1.0, (), "micp", "scip", paths=((0,),), cycles=((1, 2),))
    assert str(claim).splitlines()[-1] == "cycle         targets 1, 2, flown by nobody"


def test_tours_of_unlike_agents_name_their_type():
    tour = dataclasses.replace(SOLUTION.tours[0], agent=1)
    last = str(dataclasses.replace(SOLUTION, tours=(tour,))).splitlines()[-1]
    assert last == "tour 0        by an agent of type 1: target 0 at 12.50 s; back at 40.00 s"
