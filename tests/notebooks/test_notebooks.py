"""Every notebook runs from top to bottom, and says what its committed copy says."""

from pathlib import Path

import nbformat
import pytest
from nbconvert.preprocessors import ExecutePreprocessor

NOTEBOOKS = sorted((Path(__file__).parents[2] / "notebooks").glob("*.ipynb"))


def _code_cells(notebook):
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def _said(cell):
    """Return the text of a cell's outputs; pictures count by their presence."""
    return "".join(output.get("text", "") or output.get("data", {}).get("text/plain", "") for output in cell.outputs)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_the_committed_notebook_is_executed_in_order_and_without_errors(path):
    cells = _code_cells(nbformat.read(path, as_version=4))
    assert [cell.execution_count for cell in cells] == list(range(1, len(cells) + 1))
    assert not [output for cell in cells for output in cell.outputs if output.output_type == "error"]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_fresh_run_says_the_same(path, tmp_path):
    """It runs beside a `figures` folder of its own, so the repository stays as it is."""
    committed = nbformat.read(path, as_version=4)
    fresh = nbformat.read(path, as_version=4)
    (tmp_path / "notebooks").mkdir()
    (tmp_path / "figures").mkdir()
    ExecutePreprocessor(timeout=280).preprocess(fresh, {"metadata": {"path": str(tmp_path / "notebooks")}})
    for before, after in zip(_code_cells(committed), _code_cells(fresh)):
        assert _said(after) == _said(before), before.source


def test_there_are_notebooks():
    assert [path.name for path in NOTEBOOKS][:1] == ["01-first-solve.ipynb"]
