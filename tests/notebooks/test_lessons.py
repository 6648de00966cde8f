"""The plans of lessons: their minutes add up, and are those of the sections, tasks and questions that they name."""

import re

import pytest

from mamttsp.study.course import notebooks, read_sections
from tests.notebooks.running import ROOT

EXERCISES = ROOT / "notebooks" / "exercises"
PLANS = re.split(r"^## ", (EXERCISES / "lessons.md").read_text(encoding="utf-8"), flags=re.MULTILINE)[1:]
SECTIONS = {path.name[:2]: read_sections(path) for path in notebooks(ROOT / "notebooks")}
GUIDE = (EXERCISES / "README.md").read_text(encoding="utf-8")
TASKS = {number: int(m) for number, m in re.findall(r"^\| (\d\d\.\d) .+? \| \w+ \| (\d+) \|", GUIDE, re.MULTILINE)}
BOARD = set(re.findall(r"^\*\*(B\d+) ", (EXERCISES / "board.md").read_text(encoding="utf-8"), re.MULTILINE))
of_each_plan = pytest.mark.parametrize("plan", PLANS, ids=lambda plan: plan.partition(" ")[0])


def rows(plan):
    """Return [(minutes, kind, what)]."""
    return [
        (int(m), kind, what) for m, kind, what in re.findall(r"^\| (\d+) \| (\w+) \| (.*?) ?\|$", plan, re.MULTILINE)
    ]


def test_there_are_plans_of_two_four_and_eight_hours():
    assert [plan.partition(":")[0] for plan in PLANS] == ["Two hours", "Four hours", "Eight hours"]
    assert [sum(minutes for minutes, _, _ in rows(plan)) for plan in PLANS] == [120, 240, 480]


@of_each_plan
def test_talks_take_what_their_sections_count(plan):
    talks = [(minutes, what) for minutes, kind, what in rows(plan) if kind == "talk"]
    assert talks
    for minutes, what in talks:
        number, names = what[:2], what[4:].split("; ")
        assert not [name for name in names if name not in SECTIONS[number]], f"{what}: {list(SECTIONS[number])}"
        counted = sum(SECTIONS[number][name] for name in names)
        assert 0.75 * counted <= minutes <= counted + 6, f"{what}: {counted:.1f} minutes are counted, not {minutes}"


@of_each_plan
def test_tasks_take_what_their_sheets_say(plan):
    given = [(minutes, what.split(", ")) for minutes, kind, what in rows(plan) if kind == "task"]
    assert given and not [row for row in given if row[0] != sum(TASKS[number] for number in row[1])]


@of_each_plan
def test_questions_for_the_board_are_there_and_no_stretch_is_without_a_break(plan):
    named = {name for _, kind, what in rows(plan) if kind == "board" for name in what.split(", ")}
    assert named and named <= BOARD
    stretch = 0
    for minutes, kind, _ in rows(plan):
        stretch = 0 if kind in ("break", "meal") else stretch + minutes
        assert stretch <= 120
