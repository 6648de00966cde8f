"""The exercises: solutions that pass their checks, checks that fail without them and on the mistakes to expect."""

import re
import shlex
import subprocess
import sys
from pathlib import Path

import nbformat
import pytest

from mamttsp.study.course import notebooks
from tests.notebooks.running import CHECKED, ROOT, assert_executed, execute_whole, lay_out, run
from tests.notebooks.wrong_answers import WRONG

FOLDER = ROOT / "notebooks" / "exercises"
SHEETS = notebooks(FOLDER)
GUIDE = (FOLDER / "README.md").read_text(encoding="utf-8")
HEAD = re.compile(r"## Task (\d\d\.\d): (.+)\n\n\*Grade: (easy|medium|hard)\. About (\d+) minutes\. Needs: .+\.\*\n\n")
of_each_sheet = pytest.mark.parametrize("path", SHEETS, ids=lambda path: path.stem)


def read(path):
    return nbformat.read(path, as_version=4).cells


def tagged(cell, tag):
    return tag in cell.metadata.get("tags", [])


def tasks(path):
    """Return {number: cells of the task, its statement first}."""
    found = {}
    for cell in read(path):
        if tagged(cell, "task"):
            found[HEAD.match(cell.source)[1]] = []
        if found:
            list(found.values())[-1].append(cell)
    return found


ALL = {number: (path, cells) for path in SHEETS for number, cells in tasks(path).items()}
of_each_task = pytest.mark.parametrize("number", ALL)


def test_there_are_enough_tasks_of_every_grade_on_every_notebook():
    assert len(ALL) >= 12
    assert {number[:2] for number in ALL} == {f"{k:02}" for k in range(2, 10)}
    assert {HEAD.match(cells[0].source)[3] for _, cells in ALL.values()} == {"easy", "medium", "hard"}


@of_each_task
def test_a_task_has_statement_stub_folded_solution_and_check(number):
    path, cells = ALL[number]
    assert path.stem[:2] == number[:2]
    _, stub, solution, says, check, *_ = cells
    assert tagged(stub, "stub") and f'raise NotImplementedError("Task {number}: ' in stub.source
    assert tagged(solution, "solution") and solution.metadata["jupyter"]["source_hidden"]
    assert tagged(says, "check") and says.cell_type == "markdown"
    assert tagged(check, "check") and tagged(check, CHECKED) and f"Task {number}: right" in check.outputs[0].text


def test_the_guide_lists_the_tasks_with_their_grades_and_minutes():
    heads = [HEAD.match(cells[0].source).groups() for _, cells in ALL.values()]
    assert re.findall(r"^\| (\d\d\.\d) (.+?) \| (\w+) \| (\d+) \|", GUIDE, re.MULTILINE) == heads
    assert GUIDE.startswith(f"# Exercises: a guide for teachers\n\n{len(heads)} tasks")
    assert set(re.findall(r"\b\d\d\.\d\b", GUIDE)) == set(ALL)


@of_each_sheet
def test_it_executes_from_top_to_bottom(path, tmp_path):
    outcome = execute_whole(lay_out(path, tmp_path))
    assert outcome.returncode == 0, outcome.stdout


@of_each_sheet
def test_the_solutions_pass_the_checks_and_say_what_is_committed(path, tmp_path):
    outcome = run(lay_out(path, tmp_path))
    assert outcome.returncode == 0, outcome.stdout


@of_each_sheet
def test_the_committed_sheet_is_executed_in_order_and_without_errors(path):
    assert_executed(path)


@pytest.fixture(scope="module")
def handouts(tmp_path_factory):
    """The folder of the sheets without solutions, made by the guide's own command."""
    folder = tmp_path_factory.mktemp("handouts")
    command = re.search(r"^\.venv/bin/(jupyter nbconvert .+)$", GUIDE, re.MULTILINE)[1]
    command = command.replace("--output-dir handouts", f"--output-dir {folder}")
    words = [word for part in shlex.split(command) for word in (sorted(ROOT.glob(part)) if "*" in part else [part])]
    words[0] = Path(sys.executable).parent / words[0]
    subprocess.run(words, cwd=ROOT, check=True, capture_output=True, timeout=120)
    return folder


def execute(cells, names):
    """Run code cells in this process, with the names of what ran before."""
    for cell in cells:
        if cell.cell_type == "code":
            exec(compile(cell.source, cell.id, "exec"), names)


@of_each_sheet
def test_without_the_solutions_every_check_says_what_is_missing(path, handouts):
    names = {}
    cells = read(handouts / path.name)
    assert not [cell for cell in cells if tagged(cell, "solution") or cell.get("outputs")]
    execute([cell for cell in cells if cell.id == "setup"], names)
    for number, (_, stub, _, check, *_) in tasks(handouts / path.name).items():
        execute([stub], names)
        with pytest.raises(NotImplementedError, match=f"Task {number}: replace this line by your own code"):
            execute([check], names)


@of_each_task
def test_a_check_refuses_the_mistake_to_expect(number):
    """The stub is followed by a wrong answer; the check stops with a sentence of its own."""
    path, (_, stub, _, _, check, *_) = ALL[number]
    names = {}
    execute([cell for cell in read(path) if cell.id == "setup"], names)
    execute([stub], names)
    exec(WRONG[number][0], names)
    with pytest.raises(AssertionError) as failure:
        execute([check], names)
    assert re.search(WRONG[number][1], str(failure.value)), failure.value
