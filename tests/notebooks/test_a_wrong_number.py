"""A test of the test: a number that moved does not go unnoticed, nor does a cell that fails."""

import nbformat
import pytest

from tests.notebooks.running import CHECKED, LIMITS, ROOT, execute_whole, lay_out, run


@pytest.fixture
def beginning(tmp_path):
    """The beginning of the first solve, up to its first marked number: the path, the notebook and that last cell."""
    path = lay_out(ROOT / "notebooks" / "01-first-solve.ipynb", tmp_path)
    notebook = nbformat.read(path, as_version=4)
    first = next(i for i, cell in enumerate(notebook.cells) if CHECKED in cell.metadata.get("tags", []))
    del notebook.cells[first + 1 :]
    return path, notebook, notebook.cells[-1]


def outcome(path, notebook, by=run):
    nbformat.write(notebook, path)
    return by(path)


def test_the_beginning_itself_is_right(beginning):
    path, notebook, _ = beginning
    assert outcome(path, notebook).returncode == 0
    assert outcome(path, notebook, by=execute_whole).returncode == 0


def test_a_wrong_number_fails(beginning):
    path, notebook, cell = beginning
    committed = cell.outputs[0].data["text/plain"]
    assert "400 to 480" in committed
    cell.outputs[0].data["text/plain"] = committed.replace("400 to 480", "400 to 481")
    failed = outcome(path, notebook)
    assert failed.returncode == 1 and "400 to 481" in failed.stdout and "mismatch" in failed.stdout


def test_a_cell_that_raises_fails(beginning):
    path, notebook, cell = beginning
    cell.source = "assert False, 'nine targets'"
    failed = outcome(path, notebook)
    assert failed.returncode == 1 and "Notebook cell execution failed" in failed.stdout


def test_a_cell_that_raises_fails_when_executed_whole(beginning):
    path, notebook, cell = beginning
    cell.source = "assert False, 'nine targets'"
    failed = outcome(path, notebook, by=execute_whole)
    assert failed.returncode == 1 and "nine targets" in failed.stdout


def test_a_cell_without_end_fails_when_executed_whole(beginning, monkeypatch):
    path, notebook, cell = beginning
    monkeypatch.setitem(LIMITS, "cell", 5)
    cell.source = "while True: pass"
    failed = outcome(path, notebook, by=execute_whole)
    assert failed.returncode == 1 and "timed out" in failed.stdout.lower()
