"""Notebooks 01, 02 and 10 tell one story: the file that the others read is the instance that 01 writes down."""

import nbformat

from mamttsp import Instance
from tests.notebooks.running import ROOT

FOLDER = ROOT / "notebooks"


def test_the_file_is_what_the_first_notebook_writes_down():
    cells = {cell.id: cell.source for cell in nbformat.read(FOLDER / "01-first-solve.ipynb", as_version=4).cells}
    names = {}
    for name in ("cell-03", "cell-06"):  # its imports, and the instance
        exec(compile(cells[name], name, "exec"), names)
    assert names["instance"] == Instance.read(FOLDER / "drones.json")
