"""The results file: whole lines or none, one row a run, and a clear word about every file that is not ours."""

import json
from dataclasses import asdict

import pytest

from mamttsp import InputError, check, paper_instance, solve
from mamttsp.experiments import read_rows, tours_of
from mamttsp.experiments.campaigns.results import Results
from mamttsp.experiments.campaigns.rows import COLUMNS
from tests.experiments.fakes import fake_run, indices, largest_file


def _row(index, **fields):
    return asdict(fake_run(index)) | {"status": "optimal"} | fields


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "rows.csv"
    with Results(path) as results:
        for index in range(3):
            results.append(_row(index, message="two\nlines, and a comma"))
    return path


def test_rows_come_back_as_they_were_written(path):
    first, *_ = read_rows(path)
    assert tuple(first) == COLUMNS and indices(path) == [0, 1, 2]
    assert (first["time_limit"], first["modeler"], first["message"]) == ("0.01", "", "two lines, and a comma")


def test_a_run_has_one_row(path):
    before = path.read_bytes()
    with Results(path) as results:
        results.append(_row(1, status="crashed"))
    assert path.read_bytes() == before


@pytest.mark.parametrize("missing", [1, 2, 60])
def test_a_truncated_last_line_is_a_run_to_do_again(path, missing):
    whole = path.read_bytes()
    path.write_bytes(whole[:-missing])
    assert indices(path) == [0, 1]
    with Results(path) as results:
        assert len(results.keys()) == 2
        results.append(_row(2, message="two\nlines, and a comma"))
    assert path.read_bytes() == whole


def test_a_file_cut_off_in_its_first_line_starts_anew(path):
    first_line = path.read_bytes().split(b"\n")[0]
    path.write_bytes(first_line[:-3])
    with Results(path) as results:
        assert results.keys() == set()
    assert path.read_bytes() == first_line + b"\n"


@pytest.mark.parametrize(
    "change, message",
    [
        (lambda text: text.replace(",cpu,", ",", 1), "columns of another version .missing cpu"),
        (lambda text: text.replace(",cpu,", ",processor,", 1), "missing cpu; unknown processor"),
        (lambda text: text.replace("n,index,", "index,n,", 1), "in another order"),
        (lambda text: text.replace("optimal", "optimal,optimal", 1), "line 2: expected .* fields, found"),
        (lambda text: "a shopping list", "not a campaign's results"),
        (lambda text: "\x00\udcff\n", "not a campaign's results|another version"),
    ],
)
def test_a_file_that_is_not_ours_is_refused_and_left_alone(path, change, message):
    changed = change(path.read_text()).encode(errors="surrogateescape")
    path.write_bytes(changed)
    for read in (read_rows, Results):
        with pytest.raises(InputError, match=message) as error:
            read(path)
        assert str(error.value).startswith(str(path)) and "\n" not in str(error.value)
    assert path.read_bytes() == changed


@pytest.mark.parametrize("name", ["", "no/such/folder.csv"])
def test_an_unwritable_path_is_one_clear_line(tmp_path, name):
    with pytest.raises(InputError, match=r"cannot be written: (Is a directory|No such file or directory)$"):
        Results(tmp_path / name)


def test_a_full_disk_leaves_the_rows_as_they_were(path):
    before = path.read_bytes()
    with Results(path) as results:
        message = "cannot be written: File too large; the rows written so far are whole"
        with largest_file(len(before) + 20), pytest.raises(InputError, match=message):
            results.append(_row(3))
        assert path.read_bytes() == before
        results.append(_row(3))
    assert indices(path) == [0, 1, 2, 3]


def test_the_tours_of_a_row_can_be_checked(tmp_path):
    instance = paper_instance(5, 0, 20, 2)
    solution = solve(instance)
    with Results(tmp_path / "rows.csv") as results:
        results.append(_row(0, tours=json.dumps([tour.to_dict() for tour in solution.tours])))
    (row,) = read_rows(tmp_path / "rows.csv")
    assert tours_of(row) == solution.tours
    assert check(instance, tours_of(row)) == pytest.approx(solution.objective)
