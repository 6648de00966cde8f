"""Slides of the notebooks, which need no network: `make slides`, or `python docs/slides.py FOLDER`.

The notebooks carry no marks of slides: what is shown follows from what a cell is, so slides never lag behind. A section
begins with its heading and first sentence; each picture, formula, table and list has a slide, and so has short code
with a short answer. All other prose goes into the speaker's notes (press S).
"""

import html
import re
import shutil
import sys
from importlib.util import find_spec
from pathlib import Path

import nbformat
from nbconvert import SlidesExporter
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from mamttsp.study.course import notebooks

DOCS = Path(__file__).parent
IN_WORDS = "*In words:*"
MOST_LINES = {"code": 9, "answer": 9, "list": 12}
#: of reveal.js, whose copy the package sphinx-revealjs brings
REVEAL = ("dist/reveal.css", "dist/reveal.js", "dist/theme/white.css", "plugin/notes/notes.js", "LICENSE")


def write_slides(folder):
    """Write a page of slides for each notebook, a list of them, and what they load, into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    _lay_out_scripts(folder)
    exporter = SlidesExporter(extra_template_basedirs=[str(DOCS)], template_name="slide_pages", reveal_theme="white")
    exporter.reveal_url_prefix = "reveal"
    entries = []
    for path in notebooks(DOCS.parent / "notebooks"):
        notebook = nbformat.read(path, as_version=4)
        resources = {"metadata": {"name": path.stem}}
        text, _ = exporter.from_notebook_node(slides_of(notebook), resources=resources)
        (folder / f"{path.stem}.html").write_text(text, encoding="utf-8")
        title = re.match(r"# (.+)", notebook.cells[0].source)[1]
        entries.append(f'<li><a href="{path.stem}.html">{path.stem[:2]} {html.escape(title)}</a></li>')
    page = '<!DOCTYPE html><html lang="en"><meta charset="utf-8"><title>Slides</title><h1>Slides</h1><ul>{}</ul></html>'
    (folder / "index.html").write_text(page.format("\n".join(entries)), encoding="utf-8")


def slides_of(notebook):
    """Return a notebook of the slides of a notebook."""
    cells = []
    for k, cell in enumerate(notebook.cells):
        below = notebook.cells[k + 1].source if k + 1 < len(notebook.cells) else ""
        cells += _of_prose(cell.source) if cell.cell_type == "markdown" else _of_code(cell, below)
    return new_notebook(cells=cells, metadata=notebook.metadata)


def _of_prose(source):
    """The slides of a Markdown cell: what begins a section, what stands out, and notes for the rest."""
    if source.startswith(IN_WORDS):  # described with its picture
        return []
    source = re.sub(r"\[([^\]]+)\]\([^)]*\)", r"\1", source)  # pages that are linked to are elsewhere
    blocks = [block for block in re.split(r"\n\s*\n", source) if block.strip()]
    cells, notes, fresh = [], [], False
    for block in blocks:
        if re.match(r"#+ ", block):
            heading, _, rest = block.partition("\n")
            cells.append(_slide(heading, "slide" if heading.count("#", 0, 3) < 3 else "subslide"))
            fresh, block = True, rest
        if not block.strip():
            continue
        if fresh and not _stands_out(block):
            cells[-1].source += f"\n\n{_first_sentence(block)}"
            notes.append(block)
        elif fresh:
            cells[-1].source += f"\n\n{block}"
        elif _stands_out(block):
            before = _last_sentence(notes[-1]) if notes else ""
            if before and cells and cells[-1].source.endswith(before):
                cells[-1].source += f"\n\n{block}"
            else:
                cells.append(_slide(f"{before}\n\n{block}", "subslide"))
        else:
            notes.append(block)
        fresh = False
    return cells + ([_slide("\n\n".join(notes), "notes")] if notes else [])


def _of_code(cell, below):
    """The slides of a code cell: its pictures, or short code with a short answer."""
    pictures = [output.data["image/png"] for output in cell.outputs if "image/png" in output.get("data", {})]
    if pictures:
        words = re.sub(r"[*$`]", "", below.removeprefix(IN_WORDS)).strip() if below.startswith(IN_WORDS) else ""
        shown = [
            _slide(f'<img src="data:image/png;base64,{png.strip()}" alt="{html.escape(words)}">', "subslide")
            for png in pictures
        ]
        return [*shown, _slide(words, "notes")] if words else shown
    if any({"text/html", "text/markdown"} & set(output.get("data", ())) for output in cell.outputs):
        return []  # tables with links, films
    answer = "".join(output.get("text", "") or output.get("data", {}).get("text/plain", "") for output in cell.outputs)
    short = cell.source.count("\n") < MOST_LINES["code"] and answer.count("\n") < MOST_LINES["answer"]
    if not (short and answer.strip()):
        return []
    shown = new_code_cell(cell.source, outputs=cell.outputs, execution_count=None)
    shown.metadata.slideshow = {"slide_type": "subslide"}
    return [shown]


def _stands_out(block):
    """Tell whether a block is a formula, a table, or a list that fits on a slide."""
    lines = block.splitlines()
    listed = all(re.match(r"([-*]|\d+\.) |\s", line) for line in lines) and len(lines) <= MOST_LINES["list"]
    return block.startswith(("$$", "|")) or listed


def _slide(source, kind):
    return new_markdown_cell(source, metadata={"slideshow": {"slide_type": kind}})


def _first_sentence(text):
    return _sentences(text)[0]


def _last_sentence(text):
    return _sentences(text)[-1]


def _sentences(text):
    return re.split(r"(?<=[.?!:])\s+(?=[A-Z*$`])", text.strip())


def _lay_out_scripts(folder):
    reveal = Path(find_spec("sphinx_revealjs").origin).parent / "_static" / "revealjs"
    mathjax = Path(find_spec("sphinx-mathjax-offline").origin).parent / "static" / "mathjax" / "tex-svg-full.js"
    for name in REVEAL:
        (folder / "reveal" / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(reveal / name, folder / "reveal" / name)
    fonts = "dist/theme/fonts/source-sans-pro"
    shutil.copytree(reveal / fonts, folder / "reveal" / fonts, dirs_exist_ok=True)
    shutil.copy2(mathjax, folder / "reveal")


if __name__ == "__main__":
    write_slides(Path(sys.argv[1]))
