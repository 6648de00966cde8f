"""What is best known of the library: it grows for the better only, notes changes, and `verify` finds what is wrong."""

import csv
import dataclasses
import json
import shutil
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from mamttsp import InputError, Solution, TourError, check, load, solve
from mamttsp.experiments.summaries.best_solutions import (
    CHANGES,
    COLUMNS,
    TABLE,
    Contribution,
    line_faults,
    of_rows,
    update,
)
from mamttsp.experiments.verification import verify
from mamttsp.library import FOLDER

NAME, TYPES = "n05-i00-w40", "types-n10-i00-w40"


@pytest.fixture(scope="module")
def found():
    """The best tours of an instance, found with two agents, and longer ones: the best for shorter windows."""
    best, longer = (solve(load(name, n_agents=2), method="micp") for name in (NAME, "n05-i00-w20"))
    assert longer.objective > best.objective
    return best, longer


@pytest.fixture
def folder(tmp_path):
    for name in (NAME, TYPES):
        shutil.copy(FOLDER / f"{name}.json", tmp_path)
    manifest = json.loads((FOLDER / "manifest.json").read_text())["files"]
    sums = {f"{name}.json": manifest[f"{name}.json"] for name in (NAME, TYPES)}
    (tmp_path / "manifest.json").write_text(json.dumps({"files": sums}))
    return tmp_path


def _found(solution, by, bound=None):
    return Contribution(NAME, 2, solution.tours, bound, by, by)


def _table(folder, name=TABLE):
    with (folder / name).open(newline="") as file:
        return list(csv.DictReader(file))


def test_the_table_grows_for_the_better_and_notes_changes(folder, found):
    best, longer = found
    update(folder, [_found(longer, "one", 50.0)])
    (line,) = _table(folder)
    assert tuple(line) == COLUMNS and line["status"] == "feasible" and float(line["objective"]) == longer.objective
    assert _table(folder, CHANGES) == []
    update(folder, [_found(best, "two", best.bound), _found(longer, "three", 60.0)])
    (line,) = _table(folder)
    assert line["status"] == "optimal" and float(line["objective"]) == best.objective and line["objective_by"] == "two"
    changed = [
        (entry["what"], float(entry["before"]), float(entry["after"]), entry["by"]) for entry in _table(folder, CHANGES)
    ]
    assert changed == [("objective", longer.objective, best.objective, "two"), ("bound", 50.0, best.bound, "two")]
    stored = Solution.read(folder / line["solution"])
    assert stored.status == "optimal" and check(load(NAME, 2), stored) == best.objective
    before = {path: path.read_bytes() for path in folder.rglob("*.*")}
    update(folder, [_found(longer, "four", 1.0)])
    assert {path: path.read_bytes() for path in folder.rglob("*.*")} == before


def test_a_better_bound_alone_changes_the_status_in_the_solution_too(folder, found):
    update(folder, [_found(found[0], "one", 50.0)])
    update(folder, [Contribution(NAME, 2, (), found[0].bound, "", "two")])
    (line,) = _table(folder)
    assert (line["status"], line["objective_by"], line["bound_by"]) == ("optimal", "one", "two")
    assert Solution.read(folder / line["solution"]).bound == found[0].bound


def test_a_bound_without_tours_is_known_as_such(folder):
    update(folder, [Contribution(NAME, 2, (), 12.5, "", "one")])
    assert [(line["status"], line["objective"], line["solution"]) for line in _table(folder)] == [("unknown", "", "")]
    assert line_faults(folder, _table(folder)[0]) == []


def test_types_of_agents_have_their_own_number(folder):
    tours = solve(load(TYPES), method="micp", gap=1.0, time_limit=60).tours
    update(folder, [Contribution(TYPES, 3, tours, None, "one", "one")])
    (line,) = _table(folder)
    assert line["solution"] == f"best/{TYPES}-m3.json" and line_faults(folder, line) == []


def test_what_is_wrong_is_not_taken(folder, found):
    late = [dataclasses.replace(tour, return_time=1e4) for tour in found[0].tours]
    with pytest.raises(TourError, match="after the horizon"):
        update(folder, [Contribution(NAME, 2, tuple(late), None, "one", "one")])
    with pytest.raises(InputError, match=f"^{NAME}, 2 agents: the bound 1000.0 is above"):
        update(folder, [_found(found[0], "one", 1000.0)])
    assert not (folder / TABLE).exists()


def test_cut_short_in_writing_it_leaves_the_table_as_it_was(folder, found, monkeypatch):
    update(folder, [_found(found[1], "one", 50.0)])
    before, write = (folder / TABLE).read_bytes(), Path.write_bytes

    def half(path, data):
        write(path, data[: len(data) // 2])
        raise KeyboardInterrupt

    monkeypatch.setattr(Path, "write_bytes", half)
    with pytest.raises(KeyboardInterrupt):
        update(folder, [_found(found[0], "two", 60.0)])
    assert (folder / TABLE).read_bytes() == before
    monkeypatch.setattr(Path, "write_bytes", write)
    update(folder, [_found(found[0], "two", 60.0)])  # does what was cut short
    assert _faults(folder) == [] and _table(folder)[0]["objective_by"] == "two"


def test_what_a_campaign_knows(found):
    tours = json.dumps([tour.to_dict() for tour in found[0].tours])
    row = {"n": 5, "index": 0, "total_window": 40, "agents": 2, "objective": 1.0, "objective_by": "a", "bound": 0.5}
    (one,) = of_rows(pd.DataFrame([row | {"bound_by": "b", "tours": tours}]))
    assert one == Contribution(NAME, 2, found[0].tours, 0.5, "a", "b")
    (none,) = of_rows(pd.DataFrame([row | {"bound": float("nan"), "bound_by": "", "tours": "[]"}]))
    assert (none.tours, none.bound) == ((), None)


def _faults(folder):
    return [fault for _, faults in verify(folder) for fault in faults]


def test_verify_finds_a_byte_a_tour_and_a_row_that_are_spoiled(folder, found):
    update(folder, [_found(found[0], "one", found[0].bound)])
    assert _faults(folder) == []
    line = _table(folder)[0]
    solution, table, instance = folder / line["solution"], folder / TABLE, folder / f"{NAME}.json"
    spoiled = {
        instance: (instance.read_text().replace("150.0", "150.1", 1), "its sha256 sum is"),
        solution: (solution.read_text().replace('"time": ', '"time": 1', 1), "line 2: tour 0"),
        table: (
            table.read_text().replace(line["objective"], "1.0", 1),
            "line 2: objective 1.0, but the tours' length is",
        ),
    }
    for path, (text, message) in spoiled.items():
        good = path.read_text()
        assert text != good
        path.write_text(text)
        faults = _faults(folder)
        assert any(message in fault for fault in faults) and all("\n" not in fault for fault in faults)
        path.write_text(good)
    solution.unlink()
    assert any("cannot be read" in fault for fault in _faults(folder))


@pytest.mark.parametrize(
    "field, value, message",
    [
        ("name", "n05-i00-w41", "line 2: name: 'n05-i00-w41' is not in the library"),
        ("name", "n5-i00-w40", "line 2: solution best/n05-i00-w40-m2.json, but the file's name is"),
        ("agents", "3", "line 2: solution best/n05-i00-w40-m2.json, but the file's name is"),
        ("agents", "two", "line 2: invalid literal"),
        ("status", "feasible", "line 2: status feasible, but of objective and bound it is optimal"),
        ("objective", "nan", "line 2: objective nan, but the tours' length is"),
        ("objective", "", "line 2: objective unknown, but the tours' length is"),
        ("objective", "far", "line 2: objective: expected a number or nothing, found 'far'"),
        ("bound", "nan", "line 2: bound nan is above"),
        ("bound", "1000", "line 2: bound 1000.0 is above"),
        ("bound", "50", "line 2: gap_percent"),
        ("bound", "", "line 2: gap_percent"),
        ("gap_percent", "1.0", "line 2: gap_percent 1.0, but of objective and bound it is"),
        ("gap_percent", "", "line 2: gap_percent unknown, but of objective and bound it is"),
        ("objective_by", "two", "line 2: best/n05-i00-w40-m2.json says another status, objective, bound or solver"),
        ("solution", "", "line 2: claims a length and has no tours"),
        ("solution", "best/none.json", "best/none.json: cannot be read"),
    ],
)
def test_verify_finds_each_field_that_is_spoiled(folder, found, field, value, message):
    update(folder, [_found(found[0], "one", found[0].bound)])
    (line,) = _table(folder)
    _put(folder, [line | {field: value}])
    faults = _faults(folder)
    assert any(message in fault for fault in faults) and all("\n" not in fault for fault in faults)


def test_verify_finds_lines_that_are_lost_doubled_short_and_a_header_that_is_another(folder, found):
    update(folder, [_found(found[0], "one", found[0].bound)])
    table, (line,) = folder / TABLE, _table(folder)
    header, text = table.read_text().splitlines()
    _put(folder, [line, line])
    assert _faults(folder) == [f"{table}: {NAME}, 2 agents: 2 lines"]
    lost, short = f"{table}: {line['solution']}: in no line", f"{table}, line 2: expected 9 fields"
    for lines, faults in [
        ((header,), [lost]),
        ((header, text.rpartition(",")[0]), [short, lost]),
        ((header, f"{text},more"), [short]),
        ((header.replace("status", "state"), text), [f"{table}, line 1: expected the columns {', '.join(COLUMNS)}"]),
        ((), [f"{table}, line 1: expected the columns {', '.join(COLUMNS)}"]),
    ]:
        table.write_text("".join(f"{each}\n" for each in lines))
        assert _faults(folder) == faults


def test_verify_finds_another_number_of_agents_where_the_file_has_its_own(folder):
    update(folder, [Contribution(TYPES, 3, (), 12.5, "", "one")])
    _put(folder, [_table(folder)[0] | {"agents": "2"}])
    assert _faults(folder) == [f"{folder / TABLE}, line 2: agents: {TYPES} has 3, found 2"]


def test_whatever_byte_is_spoiled_verify_says_lines_and_never_fails(folder, found):
    update(folder, [_found(found[0], "one", found[0].bound)])
    paths, random = [path for path in sorted(folder.rglob("*.*")) if path.is_file()], np.random.default_rng(0)
    assert len(paths) == 6  # two instances, their manifest, the table, its changes, a solution
    noticed = dict.fromkeys(paths, 0)
    for path in paths:
        good = path.read_bytes()
        for at, byte in zip(random.integers(len(good), size=40), random.integers(256, size=40)):
            path.write_bytes(good[:at] + bytes([byte]) + good[at + 1 :])
            faults = _faults(folder)
            assert all(len(fault.splitlines()) == 1 for fault in faults)
            noticed[path] += bool(faults) or good[at] == byte
        path.write_bytes(good)
    assert {path.name: noticed[path] for path in paths if path.stem in (NAME, TYPES)} == {
        f"{NAME}.json": 40,
        f"{TYPES}.json": 40,
    }


def _put(folder, lines):
    """Write lines as the table."""
    with (folder / TABLE).open("w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(lines)
