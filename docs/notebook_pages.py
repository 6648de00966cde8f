"""Small changes to a notebook on its way to its page; the file that readers download stays as it is."""

import ast
import json
import re
from pathlib import PurePosixPath

IN_WORDS = "*In words:*"
_TO_SOURCES = re.compile(r"\[([^\]]+)\]\((?:\.\./)+mamttsp/[^)]+\)")
_TO_GLOSSARY = re.compile(r'\[([^\]]+)\]\((?:\.\./)+docs/glossary\.md(?: "([^"]+)")?\)')


def prepare(app, page, source):
    """Sphinx's event `source-read`: change the text of a page before it is read. source: a list of that one text."""
    if app.env.doc2path(page).suffix == ".ipynb":
        notebook = json.loads(source[0])
        number_heading(notebook, PurePosixPath(page).name)
        describe_pictures(notebook)
        fold_solutions(notebook)
        show_markdown(notebook)
        show_printed_code(notebook)
        drop_what_vanished(notebook)
        mark_columns(notebook)
        lead_to_pages(notebook)
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


def show_markdown(notebook):
    """Turn Markdown that a cell showed into prose below it, where links lead to pages."""
    cells = []
    for cell in notebook["cells"]:
        cells.append(cell)
        for output in list(cell.get("outputs", [])):
            if text := output.get("data", {}).get("text/markdown"):
                cell["outputs"].remove(output)
                name = f"{cell['id']}-{len(cells)}"
                cells.append({"cell_type": "markdown", "id": name, "metadata": {}, "source": text})
    notebook["cells"] = cells


def show_printed_code(notebook):
    """Show what a cell printed as code, in colours and with lines that wrap, if it is code."""
    for cell in notebook["cells"]:
        for k, output in enumerate(cell.get("outputs", [])):
            text = "".join(output.get("text", []))
            if _defines_a_function(text):
                code = {"text/markdown": f"```python\n{text}```"}
                cell["outputs"][k] = {"output_type": "display_data", "metadata": {}, "data": code}


def _defines_a_function(text):
    try:
        return any(isinstance(node, ast.FunctionDef) for node in ast.walk(ast.parse(text)))
    except SyntaxError:
        return False


def drop_what_vanished(notebook):
    """Leave out what shows nothing any more, such as a line of progress that vanished at its end: an empty box."""
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            cell["outputs"] = [output for output in cell["outputs"] if not _is_empty(output)]


def _is_empty(output):
    shown = output.get("data", {"text/plain": output.get("text", output["output_type"])})
    return not any("".join(text).strip() if isinstance(text, (str, list)) else text for text in shown.values())


def mark_columns(notebook):
    """Give a cell that printed columns the tag `columns`: its lines must not wrap, as others do."""
    for cell in notebook["cells"]:
        printed = "".join(map(_shown_as_text, cell.get("outputs", [])))
        if len(re.findall(r"\S {2,}\S.* {2,}\S", printed)) > 1:
            cell["metadata"]["tags"] = [*cell["metadata"].get("tags", []), "columns"]


def _shown_as_text(output):
    data = output.get("data", {})
    return "" if "text/html" in data else "".join(output.get("text", data.get("text/plain", "")))


def lead_to_pages(notebook):
    """Let links to the repository's README and to docs/ lead to pages of the site; to the glossary, to the term itself.

    The term is the link's title, or its text if there is none. Of links to the package's own files, which have no page,
    the text stays.
    """
    for cell in notebook["cells"]:
        if cell["cell_type"] == "markdown":
            text = "".join(cell["source"]).replace("(../README.md)", "(../index.md)")
            text = _TO_SOURCES.sub(r"\1", text)
            cell["source"] = _TO_GLOSSARY.sub(_term, text).replace("../docs/", "../")


def _term(link):
    text, title = link.groups()
    return f"{{term}}`{text} <{title or text}>`"
