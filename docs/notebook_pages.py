"""Small changes to a notebook on its way to its page; the file that readers download stays as it is."""

import json
import re
from pathlib import PurePosixPath

IN_WORDS = "*In words:*"


def prepare(app, page, source):
    """Sphinx's event `source-read`: change the text of a page before it is read. source: a list of that one text."""
    if app.env.doc2path(page).suffix == ".ipynb":
        notebook = json.loads(source[0])
        number_heading(notebook, PurePosixPath(page).name)
        describe_pictures(notebook)
        fold_solutions(notebook)
        lead_to_first_page(notebook)
        source[0] = json.dumps(notebook)


def number_heading(notebook, name):
    """Put the number of the file before the first heading, so that menus show the order."""
    first = notebook["cells"][0]
    first["source"] = re.sub(r"^# ", f"# {name[:2]} · ", "".join(first["source"]))


def describe_pictures(notebook):
    """Give a picture the words below it as its description."""
    cells = notebook["cells"]
    for cell, below in zip(cells, cells[1:]):
        words = "".join(below["source"])
        if cell["cell_type"] == "code" and words.startswith(IN_WORDS):
            description = re.sub(r"[*$`]", "", words.removeprefix(IN_WORDS)).strip()
            cell["metadata"]["mystnb"] = {"image": {"alt": description}}


def fold_solutions(notebook):
    """Fold the solutions of exercises."""
    for cell in notebook["cells"]:
        tags = cell["metadata"].get("tags", [])
        if cell["cell_type"] == "code" and "solution" in tags:
            prompts = {"code_prompt_show": "Show the solution", "code_prompt_hide": "Hide the solution"}
            cell["metadata"] |= {"tags": [*tags, "hide-input"], "mystnb": prompts}


def lead_to_first_page(notebook):
    """Let links to the repository's README lead to the first page of the site."""
    for cell in notebook["cells"]:
        cell["source"] = "".join(cell["source"]).replace("(../README.md)", "(../index.md)")
