"""Puts the questions at the ends of the notebooks below the headings of their answers, as they stand there now."""

import re
from pathlib import Path, PurePosixPath

from mamttsp.study.course import notebooks, read_questions

ROOT = Path(__file__).parents[1]


def prepare(app, page, source):
    """Sphinx's event `source-read`: change the text of a page before it is read. source: a list of that one text."""
    path = PurePosixPath(page)
    if path.parent.name == "questions" and path.name.isdigit():
        (notebook,) = (found for found in notebooks(ROOT / "notebooks") if found.name[:2] == path.name)
        source[0] = with_questions(source[0], read_questions(notebook))


def with_questions(text, questions):
    """Return a page with each question quoted below the heading that has its number. questions: {number: text}."""

    def quoted(heading):
        question = questions.get(int(heading[1]), "").replace("\n", "\n> ")
        return f"{heading[0]}\n\n> {question}"

    return re.sub(r"^## \d\d\.(\d+) .+$", quoted, text, flags=re.MULTILINE)
