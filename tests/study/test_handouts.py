"""Handouts: sheets without solutions, in a folder that can be taken anywhere."""

import json
import re

import nbformat
import pytest

from mamttsp.study.course import notebooks
from mamttsp.study.handouts import blank, hand_out, named_files
from tests.notebooks.run_all import printed, run_all
from tests.notebooks.running import ROOT

LINK = re.compile(r"\]\(([^)#\s]+)")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return hand_out(tmp_path_factory.mktemp("elsewhere") / "handouts")


def test_every_sheet_is_there_without_solutions_and_outputs(folder):
    sheets = notebooks(folder / "notebooks" / "exercises")
    assert [path.name for path in sheets] == [path.name for path in notebooks(ROOT / "notebooks" / "exercises")]
    cells = [cell for path in sheets for cell in nbformat.read(path, as_version=4).cells]
    assert not [cell for cell in cells if "solution" in cell.metadata.get("tags", []) or cell.get("outputs")]
    assert [cell for cell in cells if "stub" in cell.metadata.get("tags", [])]


def test_every_link_leads_to_a_file_of_the_folder(folder):
    links = []
    for path in [*folder.rglob("*.ipynb"), *folder.rglob("*.md")]:
        text = path.read_text(encoding="utf-8")
        if path.suffix == ".ipynb":
            cells = json.loads(text)["cells"]
            text = "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")
        links += [(path, link) for link in LINK.findall(text) if "://" not in link]
    assert len(links) >= len(notebooks(folder / "notebooks" / "exercises"))
    targets = [(path, link, (path.parent / link).resolve()) for path, link in links]
    assert not [(path, link) for path, link, target in targets if not target.is_file()]
    assert all(target.is_relative_to(folder.resolve()) for _, _, target in targets)


def test_a_sheet_runs_there_and_finds_the_files_that_it_reads(folder):
    (path,) = (folder / "notebooks" / "exercises").glob("08-*.ipynb")
    assert (folder / "paper_results" / "published.csv").is_file()
    wrong = "run_time = lambda row: (0, 1)\nspeed_up = lambda micp, baseline: (1, 1)"
    said = run_all(path, {"08.1": wrong})
    assert "Task 08.1: wrong: panel 2c" in printed(said) and "Task 08.2: not answered yet" in printed(said)


def test_nothing_is_written_over(folder):
    with pytest.raises(FileExistsError):
        hand_out(folder)


def test_a_blank_sheet_leaves_the_sheet_itself_alone():
    cell = {"cell_type": "code", "metadata": {}, "source": "1", "outputs": [1], "execution_count": 3}
    solution = {"cell_type": "code", "metadata": {"tags": ["solution"]}, "source": "2", "outputs": []}
    sheet = {"cells": [cell, solution], "nbformat": 4}
    assert blank(sheet) == {"cells": [cell | {"outputs": [], "execution_count": None}], "nbformat": 4}
    assert cell["outputs"] == [1]


def test_a_page_names_its_links_and_a_notebook_what_its_code_opens(tmp_path):
    for name in ("a.csv", "b.md", "c.png"):
        (tmp_path / name).touch()
    (tmp_path / "in").mkdir()
    page, notebook = tmp_path / "page.md", tmp_path / "in" / "n.ipynb"
    page.write_text("[one](b.md#part), [two](https://example.org/c.png), [three](gone.md)")
    cells = [nbformat.v4.new_markdown_cell("[a](../b.md)"), nbformat.v4.new_code_cell('open("../a.csv")')]
    nbformat.write(nbformat.v4.new_notebook(cells=cells), notebook)
    assert {path.name for path in named_files(page)} == {"b.md"}
    assert {path.name for path in named_files(notebook)} == {"a.csv", "b.md"}
    assert named_files(tmp_path / "c.png") == set()
