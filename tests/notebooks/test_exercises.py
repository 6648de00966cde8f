"""The exercises: solutions that pass their checks, wrong answers that are told so, a sheet that always goes on."""

import ast
import builtins
import contextlib
import functools
import io
import re
import symtable

import nbformat
import pytest

from mamttsp.study.course import notebooks
from tests.notebooks.run_all import printed, run_all, tagged
from tests.notebooks.running import CHECKED, ROOT, assert_executed, lay_out, run
from tests.notebooks.wrong_answers import WRONG

FOLDER = ROOT / "notebooks" / "exercises"
SHEETS = notebooks(FOLDER)
GUIDE = (FOLDER / "README.md").read_text(encoding="utf-8")
HEAD = re.compile(
    r"## Task (\d\d\.\d): (.+)\n\n\*Grade: (easy|medium|hard)\. About (\d+) minutes\. Needs: (.+)\.\*\n\n"
)
of_each_sheet = pytest.mark.parametrize("path", SHEETS, ids=lambda path: path.stem)


@functools.cache  # hundreds of tests look, none changes anything
def read(path):
    return nbformat.read(path, as_version=4).cells


def code_of(path, tag):
    return [cell for cell in read(path) if cell.cell_type == "code" and tagged(cell, tag)]


def tasks(path):
    """Return {number: its statement, stub, words about the check, and check}."""
    cells = read(path)
    starts = [k for k, cell in enumerate(cells) if tagged(cell, "task")]
    return {HEAD.match(cells[k].source)[1]: cells[k : k + 4] for k in starts}


def solutions(path):
    """Return {number: the code of its worked solution}, without the line that judges it."""
    found = {}
    for cell in code_of(path, "solution"):
        code, number = re.fullmatch(r'(.*)\n\n\njudge\("Worked solution (\d\d\.\d)", .*\)', cell.source, re.S).groups()
        found[number] = code
    return found


def bound(*cells):
    """Return the names that the cells bind."""
    return {
        name.get_name()
        for cell in cells
        for name in symtable.symtable(cell.source, cell.id, "exec").get_symbols()
        if name.is_assigned() or name.is_imported() or name.is_namespace()
    }


def read_globals(cell):
    """Return the global names that the functions of a cell read, built-in ones included."""

    def of(table):
        own = {name.get_name() for name in table.get_symbols() if name.is_global() and name.is_referenced()}
        return own.union(*map(of, table.get_children()))

    table = symtable.symtable(cell.source, cell.id, "exec")
    return set().union(*map(of, table.get_children()))


ALL = {number: (path, cells) for path in SHEETS for number, cells in tasks(path).items()}
SOLUTIONS = {number: code for path in SHEETS for number, code in solutions(path).items()}
of_each_task = pytest.mark.parametrize("number", ALL)


def judged(number, answer):
    """Return what is printed of an answer in place of the stub: the setup, the answer and the check are executed."""
    path, (_, _, _, check) = ALL[number]
    (setup,) = (cell for cell in read(path) if cell.id == "setup")
    names, said = {}, io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.chdir(path.parent):
        for code in (setup.source, answer, check.source):
            exec(compile(code, number, "exec"), names)
    return said.getvalue()


def test_there_are_enough_tasks_of_every_grade_on_every_notebook():
    assert len(ALL) >= 20
    assert {number[:2] for number in ALL} == {f"{k:02}" for k in (*range(2, 10), 11)}
    assert {HEAD.match(cells[0].source)[3] for _, cells in ALL.values()} == {"easy", "medium", "hard"}


@of_each_task
def test_a_task_has_statement_stub_check_and_folded_solution(number):
    path, (statement, stub, says, check) = ALL[number]
    assert path.stem[:2] == number[:2] and tagged(statement, "task")
    assert tagged(stub, "stub") and f'raise NotImplementedError("Task {number}: ' in stub.source
    assert tagged(says, "check") and says.cell_type == "markdown"
    assert tagged(check, "check") and tagged(check, CHECKED)
    assert check.outputs[0].text == f"Task {number}: not answered yet\n"
    (solution,) = (cell for cell in code_of(path, "solution") if f"Worked solution {number}" in cell.source)
    assert solution.metadata["jupyter"]["source_hidden"] and tagged(solution, CHECKED)
    assert solution.outputs[0].text.endswith(f"Worked solution {number}: right\n")


@of_each_task
def test_what_a_task_needs_is_in_its_notebook(number):
    needed = HEAD.match(ALL[number][1][0].source)[5]
    for part in re.split(r"[;,] (?=notebook)", needed):
        if found := re.match(r"notebook (\d\d)", part):
            (notebook,) = (path for path in notebooks(ROOT / "notebooks") if path.name[:2] == found[1])
            headings = "\n".join(re.findall(r"^#+ .*", "\n".join(c.source for c in read(notebook)), re.M))
            assert not [name for name in re.findall(r'"([^"]+)"', part) if name not in headings]


@of_each_sheet
def test_an_answer_keeps_its_name_and_a_check_knows_nothing_else_of_the_reader(path):
    stubs, checks, worked = code_of(path, "stub"), code_of(path, "check"), code_of(path, "solution")
    (setup,) = (cell for cell in read(path) if cell.id == "setup")
    answers = bound(*stubs)
    assert answers and not answers & bound(setup, *checks, *worked)
    assert not bound(setup, *checks) & bound(*worked)
    for check in checks:
        assert len(bound(check)) == 1
        assert read_globals(check) <= bound(setup) | set(dir(builtins))
    for solution in worked:
        assert not read_globals(solution) & answers


def test_the_guide_lists_the_tasks_with_their_grades_and_minutes():
    heads = [HEAD.match(cells[0].source).groups()[:4] for _, cells in ALL.values()]
    assert re.findall(r"^\| (\d\d\.\d) (.+?) \| (\w+) \| (\d+) \|", GUIDE, re.MULTILINE) == heads
    assert GUIDE.startswith(f"# Exercises: a guide for teachers\n\n{len(heads)} tasks")
    assert set(re.findall(r"\b\d\d\.\d\b", GUIDE)) == set(ALL)


@of_each_sheet
def test_a_fresh_run_says_what_is_committed(path, tmp_path):
    outcome = run(lay_out(path, tmp_path))
    assert outcome.returncode == 0, outcome.stdout


@of_each_sheet
def test_the_committed_sheet_is_executed_in_order_and_without_errors(path):
    assert_executed(path)


@of_each_sheet
def test_run_all_tells_no_wrong_answer_right(path):
    """A wrong answer in every stub: each is told so in one line, with its case, and the sheet goes on to its end."""
    cells = run_all(path, {number: code for number, (code, _) in WRONG.items()})
    said = printed(cells).splitlines()
    for number in tasks(path):
        (line,) = (line for line in said if line.startswith(f"Task {number}: "))
        assert re.match(rf"Task {number}: wrong: .*(?:{WRONG[number][1]})", line), line
        assert f"Worked solution {number}: right" in said
    assert not [output for cell in cells for output in cell.get("outputs", []) if output.output_type == "error"]


@of_each_task
def test_a_right_answer_is_told_right(number):
    answer = re.sub(r"(\w+)_solution\b", r"\1", SOLUTIONS[number])
    assert judged(number, answer).endswith(f"Task {number}: right\n")


NOT_AN_ANSWER = {
    "a number": "return 42.0",
    "nothing": "return None",
    "an error": "return 1 / 0",
    "a text": "return 'right'",
    "a failed assertion": "assert False",
}


@pytest.mark.parametrize("body", NOT_AN_ANSWER.values(), ids=NOT_AN_ANSWER)
@of_each_task
def test_what_is_no_answer_at_all_is_told_wrong_in_one_line(number, body):
    names = [node.name for node in ast.parse(ALL[number][1][1].source).body if isinstance(node, ast.FunctionDef)]
    said = judged(number, "\n".join(f"def {name}(*args):\n    {body}\n" for name in names))
    assert said.startswith(f"Task {number}: wrong: ") and said.count("\n") == 1, said


@of_each_task
def test_a_stub_is_not_answered_yet(number):
    assert judged(number, ALL[number][1][1].source) == f"Task {number}: not answered yet\n"
