"""Runs a notebook through nbval or nbmake, away from the repository, which so stays as it is."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import nbformat

from mamttsp.study.course import notebooks
from mamttsp.warm_up import PARTS, ensure_compiled

ROOT = Path(__file__).parents[2]
NOTEBOOKS = notebooks(ROOT / "notebooks")
CHECKED = "nbval-check-output"
LIMITS = {"cell": 90, "notebook": 280}  # seconds


def lay_out(notebook, folder):
    """Copy all notebooks, their figures and paper_results below `folder`; return the path of the notebook's copy."""
    for name in ("notebooks", "figures", "paper_results"):
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns(".ipynb_checkpoints"))
    return folder / notebook.relative_to(ROOT)


def code_cells(notebook):
    """Return the code cells of a notebook's file."""
    return [cell for cell in nbformat.read(notebook, as_version=4).cells if cell.cell_type == "code"]


def assert_executed(notebook):
    """Assert that all cells were executed in order, and none of them failed."""
    cells = code_cells(notebook)
    assert [cell.execution_count for cell in cells] == list(range(1, len(cells) + 1))
    assert not [output for cell in cells for output in cell.outputs if output.output_type == "error"]


def run(notebook):
    """Execute every cell once, in lax mode: the outputs of cells tagged nbval-check-output must be the committed ones.

    Returns the finished process of a pytest of its own: status 0 if all is well, 1 if a cell failed or said another
    thing. The kernel runs in the notebook's folder, on this Python.
    """
    return _pytest(notebook, "--nbval-lax", "--nbval-current-env", f"--nbval-cell-timeout={LIMITS['cell']}")


def execute_whole(notebook):
    """Execute a notebook with nbclient, as `jupyter nbconvert --execute` does; otherwise like `run`."""
    return _pytest(notebook, "--nbmake", f"--nbmake-timeout={LIMITS['cell']}")


def _pytest(notebook, *options):
    for part in PARTS:  # or a line that says so would be among what cells print
        ensure_compiled(part)
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *options, str(notebook)]
    alone = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST_")}
    folder, limit = notebook.parent, LIMITS["notebook"]
    return subprocess.run(command, cwd=folder, env=alone, capture_output=True, text=True, timeout=limit)
