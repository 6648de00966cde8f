"""Builds the notebooks' website: `python notebooks/website/build.py site`, or `make html`.

The site is laid out as the repository is, so links between files stay as they are, but for .ipynb and .md, which
become .html. It needs no network: mathematics is MathML, and its font lies beside the pages.
"""

import posixpath
import re
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import unquote, urlsplit

import jinja2
import nbformat
import ziamath
from bs4 import BeautifulSoup
from nbformat.v4 import new_markdown_cell, new_notebook
from page_exporter import FOLDER, PageExporter, markdown

from mamttsp.study.course import notebooks

ROOT = FOLDER.parents[1]
FONT = Path(ziamath.__file__).parent / "fonts" / "STIXTwoMath-Regular.ttf"


@dataclass
class Page:
    """A notebook and its place in the site; paths are relative to the repository and to the site alike."""

    notebook: nbformat.NotebookNode
    path: str
    previous: "Page | None" = None
    next: "Page | None" = None

    @property
    def root(self):
        """The way from this page to the site's top folder."""
        return "../" * self.path.count("/")

    @property
    def title(self):
        """The number in the file's name and the first heading."""
        number = re.match(r"\d*", Path(self.path).name)[0]
        heading = self.notebook.cells[0].source.splitlines()[0].lstrip("# ")
        return f"{number} · {heading}" if number else heading

    @property
    def learn(self):
        """What the reader will learn: the paragraph that says so, as HTML."""
        paragraphs = self.notebook.cells[0].source.split("\n\n")
        return "".join(markdown(text) for text in paragraphs if text.startswith("**You will learn**"))


def read_pages(folder):
    """Return a page for each notebook in a folder of the repository, in their order."""
    files = notebooks(ROOT / folder)
    return [Page(nbformat.read(f, as_version=4), str(f.relative_to(ROOT).with_suffix(".html"))) for f in files]


def build(site):
    """Write the whole site into a folder, which is emptied first; return the number of pages."""
    shutil.rmtree(site, ignore_errors=True)
    parts = [("Notebooks", read_pages("notebooks")), ("Exercises", read_pages("notebooks/exercises"))]
    pages = [page for _, group in parts for page in group]
    for before, after in zip(pages, pages[1:]):
        before.next, after.previous = after, before
    for page in pages:  # which grows while texts are found that pages link to
        html, _ = PageExporter().from_notebook_node(page.notebook, {"page": page})
        write(site / page.path, html)
        known = {page.path for page in pages}
        for path in linked(page, html):
            source = ROOT / path
            if path not in known and source.suffix == ".html" and source.with_suffix(".md").is_file():
                pages.append(text_page(path))
            elif source.is_file():
                write(site / path, source.read_bytes())
    contents = jinja2.Template((FOLDER / "contents.html.j2").read_text(encoding="utf-8"))
    write(site / "index.html", contents.render(parts=parts))
    for file in (FOLDER / "style.css", FONT):
        write(site / file.name, file.read_bytes())
    return len(pages) + 1


def text_page(path):
    """Return the page of a Markdown file."""
    text = (ROOT / path).with_suffix(".md").read_text(encoding="utf-8")
    return Page(new_notebook(cells=[new_markdown_cell(text)]), path)


def linked(page, html):
    """Return the paths, from the top, of what a page links to inside the site."""
    tags = BeautifulSoup(html, "html.parser").select("a[href], img[src]")
    urls = [urlsplit(tag.get("href") or tag.get("src")) for tag in tags]
    here = posixpath.dirname(page.path)
    local = {posixpath.normpath(posixpath.join(here, unquote(u.path))) for u in urls if u.path and not u.scheme}
    return sorted(local)


def write(path, content):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content.encode("utf-8") if isinstance(content, str) else content)


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    print(f"{build(folder)} pages, {folder / 'index.html'}")
