"""The map of the course says what the notebooks' cells say, and names no file that is not there."""

from pathlib import Path

import nbformat
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from mamttsp.study.course import Chapter, read_course, read_questions, read_sections, table

NOTEBOOKS = Path(__file__).parents[2] / "notebooks"
PROSE = (
    "# Flying\n\nSection IV-B of the paper, and Section III; rows from `exact.csv`, `instances/best.csv`.\n"
    + "word " * 600
)
IMPORTS = "import mamttsp\nfrom mamttsp import figures\nfrom mamttsp.motion import earliest_meeting"
CODE = 'mamttsp.check(None, ())\nprint(source("micp", "speed"))\nfigures.save(ax, "../figures/flying-high")'


def write(path, *cells):
    path.parent.mkdir(exist_ok=True)
    nbformat.write(new_notebook(cells=list(cells)), path)


def course(folder):
    write(folder / "00-overview.ipynb", new_markdown_cell("# Overview"))
    write(folder / "01-flying.ipynb", new_markdown_cell(PROSE), new_code_cell(IMPORTS), new_code_cell(CODE))
    write(folder / "02-again.ipynb", new_markdown_cell("# Again"), new_code_cell("from mamttsp.tours import check"))
    write(folder / "01-flying.nbconvert.ipynb", new_markdown_cell("# A copy"))
    write(folder / "exercises" / "01-fly.ipynb", new_markdown_cell("## Task 01.1"), new_markdown_cell("## Task 01.2"))
    return read_course(folder)


def test_a_chapter_is_what_its_cells_name(tmp_path):
    assert course(tmp_path)[0] == Chapter(
        file="01-flying.ipynb",
        title="Flying",
        sections=("III", "IV-B"),
        modules=("mamttsp.figures", "mamttsp.formulations.pyomo.micp", "mamttsp.motion", "mamttsp.tours"),
        figures=("flying-high",),
        rows=("exact.csv", "instances/best.csv"),
        exercises="exercises/01-fly.ipynb",
        tasks=2,
        minutes=10,
    )


def test_a_row_for_each_notebook_and_a_module_where_it_first_occurs(tmp_path):
    rows = table(course(tmp_path)).splitlines()[2:]
    assert len(rows) == 2
    assert "[01 Flying](01-flying.ipynb)" in rows[0] and "[2](exercises/01-fly.ipynb)" in rows[0]
    assert rows[0].startswith("| III, IV-B |") and rows[1].startswith("| beyond it |")
    assert "`tours`" in rows[0] and "`tours`" not in rows[1]


def test_every_file_that_the_course_names_is_there():
    chapters = read_course(NOTEBOOKS)
    assert [chapter.file[:2] for chapter in chapters][:5] == ["01", "02", "03", "04", "05"]
    assert not [name for chapter in chapters for name in chapter.files if not (NOTEBOOKS / name).is_file()]


def test_questions_are_those_at_the_end_with_their_lines(tmp_path):
    last = "## Summary\n\n1. No question.\n\n## Exercises\n\n1. One,\n   and more.\n2. Two?"
    write(tmp_path / "n" / "01-a.ipynb", new_markdown_cell("# A\n\n1. No."), new_markdown_cell(last))
    write(tmp_path / "n" / "02-b.ipynb", new_markdown_cell("# B"))
    assert read_questions(tmp_path / "n" / "01-a.ipynb") == {1: "One,\n   and more.", 2: "Two?"}
    assert read_questions(tmp_path / "n" / "02-b.ipynb") == {}


def test_sections_count_their_words_and_cells(tmp_path):
    cells = (
        new_markdown_cell("# A\n\nBefore the first."),
        new_markdown_cell("## One\n\n" + "word " * 98),
        new_code_cell("a = 1"),
        new_markdown_cell("## Two\n\n" + "word " * 48 + "\n\n## Three\n\n" + "word " * 198),
    )
    write(tmp_path / "n" / "01-a.ipynb", *cells)
    assert read_sections(tmp_path / "n" / "01-a.ipynb") == {"One": 1.5, "Two": 0.5, "Three": 2.0}
