"""Compiling is not solving: it happens before the clock starts, once, with a line that says so."""

import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

import mamttsp
from mamttsp import generate, paper_instance, solve, warm_up
from mamttsp.__main__ import main
from mamttsp.branch_and_bound.propagation import _sweep
from tests.examples import agents, general, still

PACKAGE = Path(mamttsp.__file__).parent
SMALL = generate(3, 20, seed=0)


@pytest.fixture
def nothing_compiled(tmp_path, monkeypatch):
    """As on a new machine, but compiling is a pause of 0.5 s; return the list of what was compiled."""
    pauses = []

    def pause(part):
        pauses.append(part)
        time.sleep(0.5)
        mark(part).touch()

    def mark(part):
        return tmp_path / part

    monkeypatch.setattr(warm_up, "_mark", mark)
    monkeypatch.setattr(warm_up, "warm_up", pause)
    return pauses


@pytest.mark.parametrize(
    "part, method, line",
    [
        ("exact", {}, "compiling the exact solver, once on this machine: about 30 s\n"),
        (
            "clarabel",
            {"method": "micp", "solver": "clarabel"},
            "compiling our branch and bound, once on this machine: about 3 s\n",
        ),
    ],
)
def test_the_first_solve_compiles_before_its_clock_starts_and_says_so(nothing_compiled, capsys, part, method, line):
    solve(SMALL, **method)  # loads what is compiled, which takes longer than the limit below
    warm_up._mark(part).unlink()
    capsys.readouterr()
    solution = solve(SMALL, time_limit=0.4, **method)
    assert solution.status == "optimal" and solution.build_time + solution.runtime < 0.4
    assert nothing_compiled == [part, part]
    told = capsys.readouterr()
    assert told.out == "" and told.err == line
    solve(SMALL, **method)
    assert len(nothing_compiled) == 2 and capsys.readouterr().err == ""


@pytest.mark.parametrize("method", [{}, {"method": "micp", "solver": "clarabel"}])
def test_ctrl_c_while_compiling_is_a_status(nothing_compiled, monkeypatch, method):
    def interrupt(part):
        raise KeyboardInterrupt

    monkeypatch.setattr(warm_up, "warm_up", interrupt)
    solution = solve(SMALL, **method)
    assert (solution.status, solution.tours, solution.bound) == ("unknown", (), None)


@pytest.mark.parametrize("solver, compiled", [("scip", []), ("clarabel", ["clarabel"]), ("highs", [])])
def test_nobody_compiles_what_it_does_not_need(nothing_compiled, solver, compiled):
    assert solve(SMALL, "micp", solver=solver).status == "optimal" and nothing_compiled == compiled


def test_the_branch_and_bound_has_nothing_left_to_compile():
    warm_up.warm_up("clarabel")
    (known,) = _sweep.signatures
    unlike = general(still(10, 0), still(0, 10), types=[agents(), agents(depot=(30.0, 0.0), max_speed=6.0)])
    for problem in (SMALL, unlike, generate(5, 40, 2, seed=1)):
        for prune in (False, True):
            assert solve(problem, "micp", solver="clarabel", prune=prune).status == "optimal"
    assert _sweep.signatures == [known]


def test_versions_can_warm_up(nothing_compiled, capsys):
    for _ in range(2):
        assert main(["versions", "--warm-up"]) == 0
    told = capsys.readouterr()
    assert nothing_compiled == ["exact", "clarabel"]
    assert told.err.count("compiling") == 2 and told.out.count("Python") == 2


@pytest.mark.parametrize("part, own", [("exact", "labels.py"), ("clarabel", "propagation.py")])
def test_the_mark_is_that_of_these_sources(monkeypatch, part, own):
    warm_up.ensure_compiled(part)
    mark = warm_up._mark(part)
    assert mark.exists()
    read = Path.read_bytes
    for changed, another in (("motion.py", True), (own, True), ("solve.py", False)):
        with monkeypatch.context() as patch:
            patch.setattr(Path, "read_bytes", lambda path: read(path) + b"# changed" * (path.name == changed))
            assert (warm_up._mark(part) != mark) == another and warm_up._mark(part).parent == mark.parent


def _run(*arguments, **variables):
    """Run the command line with these environment variables, and none of numba's but them."""
    environment = {name: value for name, value in os.environ.items() if not name.startswith("NUMBA")}
    return subprocess.run(
        [sys.executable, "-m", "mamttsp", *map(str, arguments)],
        env=environment | {name: str(value) for name, value in variables.items()},
        cwd=variables.get("PYTHONPATH"),  # which comes before PYTHONPATH
        capture_output=True,
        text=True,
    )


@pytest.fixture
def nowhere_to_write(tmp_path):
    """Return environment variables for a copy of the package and a home in which no folder can be made."""
    shutil.copytree(PACKAGE, tmp_path / "mamttsp", ignore=shutil.ignore_patterns("__pycache__"))
    for folder in [tmp_path / "mamttsp", *(path for path in (tmp_path / "mamttsp").rglob("*") if path.is_dir())]:
        (folder / "__pycache__").write_text("a file in the place of the folder")
    home = tmp_path / "a-file"
    home.write_text("no folder")
    places = ("HOME", "XDG_CACHE_HOME", "LOCALAPPDATA", "USERPROFILE")
    return {"PYTHONPATH": tmp_path, "PYTHONDONTWRITEBYTECODE": 1} | dict.fromkeys(places, home / "below")


def test_an_installation_that_cannot_be_written_to_says_what_to_set(tmp_path, nowhere_to_write):
    generating = ("generate", "--targets", 3, "--window", 20, "-o", tmp_path / "instance.json")
    done = _run(*generating, **nowhere_to_write)
    assert done.returncode == 2 and done.stdout == "" and done.stderr.count("\n") == 1
    assert done.stderr.startswith("NUMBA_CACHE_DIR: there is no folder to keep compiled code in")
    SMALL.write(tmp_path / "small.json")
    assert _run("solve", tmp_path / "small.json", **nowhere_to_write).stderr == done.stderr

    done = _run(*generating, **nowhere_to_write, NUMBA_CACHE_DIR=tmp_path / "compiled")
    assert done.returncode == 0 and done.stderr == ""
    assert list((tmp_path / "compiled").rglob("*.nbi"))


def test_a_home_that_can_be_written_to_suffices(tmp_path, nowhere_to_write):
    home = {"HOME": tmp_path, "XDG_CACHE_HOME": tmp_path / "cache", "LOCALAPPDATA": tmp_path}
    output = tmp_path / "instance.json"
    done = _run("generate", "--targets", 3, "--window", 20, "-o", output, **nowhere_to_write | home)
    assert done.returncode == 0 and done.stderr == ""


@pytest.mark.slow
def test_on_a_new_machine_a_short_limit_is_for_the_search(tmp_path):
    generate(10, 40, 3, seed=7).write(tmp_path / "instance.json")
    solving = ("solve", tmp_path / "instance.json", "--time-limit", 5)
    first, second = (_run(*solving, NUMBA_CACHE_DIR=tmp_path / "compiled") for _ in range(2))
    assert "optimal" in first.stdout and first.stderr.count("compiling the exact solver") == 1
    assert "optimal" in second.stdout and "compiling" not in second.stderr


@pytest.mark.slow
def test_after_the_warm_up_nothing_is_left_to_compile(tmp_path):
    """Hard settings, which need rounds of every kind."""
    compiled = tmp_path / "compiled"
    _run("versions", "--warm-up", NUMBA_CACHE_DIR=compiled)
    before = sorted(compiled.rglob("*.nbc"))
    assert before
    for k, setting in enumerate([(10, 18, 60, 1), (15, 1, 40, 2), (20, 3, 60, 2), (20, 0, 40, 1), (20, 1, 60, 5)]):
        problem, solution = tmp_path / f"{k}.json", tmp_path / f"{k}-solution.json"
        paper_instance(*setting).write(problem)
        done = _run("solve", problem, "--time-limit", 60, "-o", solution, NUMBA_CACHE_DIR=compiled)
        assert done.returncode == 0 and "compiling" not in done.stderr
    of_solves = [path for path in compiled.rglob("*.nbc") if "random_order" not in path.name]
    assert sorted(of_solves) == [path for path in before if "random_order" not in path.name]
