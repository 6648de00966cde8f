"""`make notebooks`: it runs a notebook, and prints nothing but its name."""

import shutil
import subprocess

import nbformat
import pytest

from tests.notebooks.running import ROOT


@pytest.mark.skipif(
    shutil.which("make") is None or not (ROOT / ".venv").exists(), reason="there is no make, or no .venv"
)
def test_the_output_is_clean(tmp_path):
    path = tmp_path / "one.ipynb"
    nbformat.write(nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell("6 * 7")]), path)
    # The environment is taken as it is, whatever its age.
    command = ["make", "--silent", "--assume-old=.venv/ready", "notebooks", f"NOTEBOOKS={path}"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (0, f"-- {path}\n", "")
    assert nbformat.read(path, as_version=4).cells[0].outputs[0].data["text/plain"] == "42"
