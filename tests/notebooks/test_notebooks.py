"""Every notebook runs from top to bottom, and its numbers are still the committed ones.

nbval executes a notebook cell by cell, each within a limit, and compares the outputs of the cells with the tag
nbval-check-output with what is committed. nbmake executes one whole, by nbclient, as `make notebooks` does with all.
"""

import pytest

from tests.notebooks.running import CHECKED, NOTEBOOKS, assert_executed, code_cells, execute_whole, lay_out, run

of_each_notebook = pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)


def checked(cell):
    return CHECKED in cell.metadata.get("tags", [])


def test_one_executes_whole(tmp_path):
    (path,) = (path for path in NOTEBOOKS if path.stem == "01-first-solve")
    outcome = execute_whole(lay_out(path, tmp_path))
    assert outcome.returncode == 0, outcome.stdout


@of_each_notebook
def test_a_fresh_run_says_the_same(path, tmp_path):
    outcome = run(lay_out(path, tmp_path))
    assert outcome.returncode == 0, outcome.stdout


@of_each_notebook
def test_the_committed_notebook_is_executed_in_order_and_without_errors(path):
    assert_executed(path)


@of_each_notebook
def test_numbers_are_marked_for_comparison_and_marked_cells_say_something(path):
    marked = [cell for cell in code_cells(path) if checked(cell)]
    assert marked and all(cell.outputs for cell in marked)


def test_the_overview_comes_first():
    assert NOTEBOOKS[0].name == "00-overview.ipynb"
