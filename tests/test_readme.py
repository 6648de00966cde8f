"""The README keeps its word: its script runs as written, its commands run, and its links lead somewhere."""

import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from mamttsp import Instance, Solution, check
from mamttsp.__main__ import main

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
(SCRIPT,) = re.findall(r"```python\n(.*?)```", README, flags=re.S)


def _run(folder, path):
    """Run the script in a folder, with the package from `path`."""
    environment = os.environ | {"PYTHONPATH": str(path), "MPLBACKEND": "agg"}
    return subprocess.run([sys.executable, "-c", SCRIPT], cwd=folder, env=environment, capture_output=True, text=True)


def test_your_own_targets_takes_ten_lines():
    assert len([line for line in SCRIPT.splitlines() if line]) <= 10


def _assert_done(ran, folder):
    said = re.sub(r"^compiling .*, once on this machine: .*\n", "", ran.stderr, flags=re.M)
    assert ran.returncode == 0 and said == ""
    assert ran.stdout.startswith("status        optimal\n") and "leg_length" in ran.stdout
    assert (folder / "plan.png").read_bytes().startswith(b"\x89PNG")


def test_your_own_targets_runs_as_written(tmp_path):
    _assert_done(_run(tmp_path, ROOT), tmp_path)


@pytest.mark.slow  # everything that numba compiles is compiled anew
def test_it_runs_from_a_fresh_wheel(tmp_path):
    source, wheels, installed, elsewhere = (tmp_path / name for name in ("source", "wheels", "installed", "elsewhere"))
    elsewhere.mkdir()
    shutil.copytree(ROOT / "mamttsp", source / "mamttsp", ignore=shutil.ignore_patterns("__pycache__"))
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, source)
    pip = [sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check"]
    subprocess.run([*pip, "wheel", "--no-deps", "--no-build-isolation", "-w", wheels, source], check=True)
    (wheel,) = wheels.glob("*.whl")
    subprocess.run([*pip, "install", "--no-deps", "--target", installed, wheel], check=True)
    where = [sys.executable, "-c", "import mamttsp; print(mamttsp.__file__)"]
    environment = os.environ | {"PYTHONPATH": str(installed)}
    found = subprocess.run(where, cwd=elsewhere, env=environment, capture_output=True, text=True, check=True)
    assert found.stdout.startswith(str(installed))
    _assert_done(_run(elsewhere, installed), elsewhere)


def test_its_commands_run_as_written(tmp_path, monkeypatch):
    commands = re.findall(r"^python -m mamttsp (.*)$", README, flags=re.M)
    monkeypatch.chdir(tmp_path)
    assert [command.split()[0] for command in commands] == ["generate", "solve", "check", "plot", "verify"]
    for command in commands[:4]:
        assert main(shlex.split(command)) == 0, command
    assert check(Instance.read("instance.json"), Solution.read("solution.json")) > 0
    assert Path("picture.gif").read_bytes().startswith(b"GIF89a")


@pytest.mark.parametrize("page", ["README.md", "mamttsp/README.md"])
def test_its_links_and_pictures_are_there(page):
    text = (ROOT / page).read_text(encoding="utf-8")
    links = re.findall(r"\]\(([^)#]+)\)", text)
    missing = [link for link in links if "://" not in link and not (ROOT / page).parent.joinpath(link).exists()]
    assert missing == []
