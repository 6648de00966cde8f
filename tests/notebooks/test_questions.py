"""The questions at the ends of the notebooks: each has a hint and a solution, and what they compute is so."""

import importlib.util
import re

import pytest

from mamttsp.study.course import notebooks, read_questions
from tests.notebooks.running import ROOT

FOLDER = ROOT / "notebooks" / "questions"
PAGES = sorted(FOLDER.glob("[0-9][0-9].md"))
ENTRY = re.compile(r"^## (\d\d)\.(\d+) (.+)\n((?:(?!## ).*\n)*)", re.MULTILINE)
of_each_page = pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)

_spec = importlib.util.spec_from_file_location("question_pages", ROOT / "docs" / "question_pages.py")
question_pages = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(question_pages)


def words(text):
    return re.findall(r"[a-z0-9]+", text.lower())


def test_every_question_has_its_entry_and_every_entry_its_question():
    read = {path.name[:2]: read_questions(path) for path in notebooks(ROOT / "notebooks")}
    asked = {(notebook, n): text for notebook, questions in read.items() for n, text in questions.items()}
    entries = {(e[1], int(e[2])): e[3] for page in PAGES for e in ENTRY.finditer(page.read_text(encoding="utf-8"))}
    assert len(asked) >= 47 and set(asked) == set(entries)
    for (notebook, n), heading in entries.items():  # small changes of a question do no harm
        known = {k: sum(word in words(text) for word in words(heading)) for k, text in read[notebook].items()}
        about = f"{notebook}.{n}: is {heading!r} still about {read[notebook][n]!r}?"
        assert known[n] >= 0.6 * len(words(heading)) and known[n] == max(known.values()), about


@of_each_page
def test_an_entry_has_a_hint_and_a_folded_solution(page):
    entries = list(ENTRY.finditer(page.read_text(encoding="utf-8")))
    assert entries and {e[1] for e in entries} == {page.stem}
    for _, _, _, body in (e.groups() for e in entries):
        hint = r"\n\*\*Hint\.\*\* \S.{20,}?\n\n<details><summary>Solution</summary>\n\n.{40,}\n\n</details>\n*"
        assert re.fullmatch(hint, body, re.DOTALL)


@of_each_page
def test_the_code_of_a_page_runs(page, monkeypatch):
    monkeypatch.chdir(ROOT / "notebooks")
    names = {}
    for block in re.findall(r"^```python\n(.*?)^```", page.read_text(encoding="utf-8"), re.M | re.S):
        assert "assert" in block or "def " in block
        exec(compile(block, page.name, "exec"), names)


def test_the_website_quotes_a_question_as_it_stands_in_the_notebook():
    text = "# A\n\n## 02.1 Move\n\n**Hint.** No.\n\n## 02.2 Why\n"
    shown = question_pages.with_questions(text, {1: "Move it\n   away.", 2: "Why?"})
    assert shown == "# A\n\n## 02.1 Move\n\n> Move it\n>    away.\n\n**Hint.** No.\n\n## 02.2 Why\n\n> Why?\n"
