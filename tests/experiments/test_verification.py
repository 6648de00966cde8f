"""`verify`: what is stored is right, or each fault is a line with its file and place."""

import csv
import json
import shutil
import time
from pathlib import Path

import numpy as np
import pytest

from mamttsp import InputError
from mamttsp.__main__ import main
from mamttsp.experiments.verification import sha256, verify

RESULTS = Path(__file__).parents[2] / "paper_results"


@pytest.fixture
def folder(tmp_path):
    """A folder with the first rows of committed tables, and two files with their sums."""
    for name in ("exact.csv", "best_known.csv"):
        lines = (RESULTS / name).read_text().splitlines()[:4]
        (tmp_path / name).write_text("\n".join(lines) + "\n")
    (tmp_path / "instances" / "small").mkdir(parents=True)
    for name in ("a.json", "small/b.json"):
        (tmp_path / "instances" / name).write_text(name)
    sums = {name: sha256(tmp_path / "instances" / name) for name in ("a.json", "small/b.json")}
    (tmp_path / "instances" / "manifest.json").write_text(json.dumps({"files": sums}))
    return tmp_path


def _faults(folder):
    return [fault for _, faults in verify(folder) for fault in faults]


def _change(path, row, **changes):
    """Change fields of a row, from 0, of a CSV file."""
    with path.open(newline="") as file:
        rows = list(csv.DictReader(file))
    rows[row] |= changes
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(rows)


def test_what_is_right_is_counted(folder, capsys):
    assert main(["verify", str(folder)]) == 0
    assert capsys.readouterr().out.splitlines() == [
        f"{folder}/best_known.csv: tours of 3 rows: correct",
        f"{folder}/exact.csv: tours of 3 rows: correct",
        f"{folder}/instances/manifest.json: sums of 2 files: correct",
    ]


def test_every_fault_is_a_line(folder, capsys):
    _change(folder / "exact.csv", 1, objective="7.5")
    (folder / "instances" / "a.json").write_text("another")
    assert main(["verify", str(folder)]) == 1
    out = capsys.readouterr().out.splitlines()
    assert out[1].startswith(f"{folder}/exact.csv, line 3: objective 7.5, but the tours' length is ")
    assert out[2] == f"{folder}/exact.csv: tours of 3 rows: 1 fault"
    assert out[3].startswith(f"{folder}/instances/manifest.json: a.json: its sha256 sum is ")
    assert len(out) == 5


TOURS = json.dumps([{"visits": [{"target": 0, "time": 1.0, "position": [0, 0]}], "return_time": 2.0}])


@pytest.mark.parametrize(
    "changes, message",
    [
        ({"tours": TOURS}, "target 1 is visited 0 times, not once"),
        ({"tours": "[7]"}, "row.tours[0]: expected visits (a list) and return_time (a number)"),
        ({"tours": "{"}, "row.tours: not JSON: Expecting property name"),
        ({"tours": ""}, "claims a solution and has no tours"),
        ({"bound": "999"}, "bound 999 is above the tours' length"),
        ({"objective": "long"}, "could not convert string to float: 'long'"),
        ({"n": "7"}, "n: expected one of (5, 10, 15, 20), found 7"),
    ],
)
def test_a_row_that_is_wrong_is_named_by_its_line(changes, message, folder):
    _change(folder / "exact.csv", 2, **changes)
    assert any(fault.startswith(f"{folder}/exact.csv, line 4: {message}") for fault in _faults(folder))


def test_a_quotation_mark_that_swallows_the_rest_of_a_table_is_a_line(folder):
    path = folder / "exact.csv"
    lines = path.read_text().splitlines(keepends=True)
    swallowed = "".join(lines[2:]) * (csv.field_size_limit() // len(lines[2]) + 1)
    path.write_text("".join(lines[:2]) + '"' + swallowed.replace('"', "'"))
    assert _faults(folder) == [f"{path}, line 3: field larger than field limit ({csv.field_size_limit()})"]


def test_whatever_byte_of_a_table_is_spoiled_verify_says_lines_and_never_fails(folder):
    path, random = folder / "exact.csv", np.random.default_rng(0)
    good, found = path.read_bytes(), 0
    for at, byte in zip(random.integers(len(good), size=60), random.integers(256, size=60)):
        path.write_bytes(good[:at] + bytes([byte]) + good[at + 1 :])
        faults = _faults(folder)
        assert all(len(fault.splitlines()) == 1 for fault in faults)
        found += bool(faults)
    assert found > 30  # of the others, most are in what nothing can be held against: times, versions, the last digits


def test_a_run_without_an_answer_needs_no_tours(folder):
    _change(folder / "exact.csv", 0, status="unknown", objective="", bound="", tours="[]")
    assert _faults(folder) == []


@pytest.mark.parametrize("text", ["not json", "[]", "{}", '{"files": ["a.json"]}'])
def test_a_manifest_that_is_none_is_a_fault(text, folder):
    (folder / "instances" / "manifest.json").write_text(text)
    assert _faults(folder) == [
        f'{folder}/instances/manifest.json: expected an object with "files", names and their sha256 sums'
    ]


def test_a_file_that_is_gone_is_a_fault(folder):
    (folder / "instances" / "a.json").unlink()
    assert _faults(folder) == [f"{folder}/instances/manifest.json: a.json: there is no such file"]


def test_where_there_is_nothing_to_verify_that_is_said(tmp_path, capsys):
    assert main(["verify", str(tmp_path / "nowhere")]) == 2
    assert "nowhere: there is no such folder" in capsys.readouterr().err
    shutil.copy(RESULTS / "scale.csv", tmp_path)
    with pytest.raises(InputError, match="holds no table with tours and no manifest.json"):
        list(verify(tmp_path))


@pytest.mark.slow
def test_the_committed_results_are_right_and_that_takes_less_than_a_minute():
    start = time.process_time()
    assert _faults(RESULTS) == []
    assert time.process_time() < start + 60.0
