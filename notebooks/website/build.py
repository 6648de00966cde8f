"""Builds the notebooks' website: `python notebooks/website/build.py site`, or `make html`.

The site is laid out as the repository is, so links between files stay as they are, but for .ipynb, which becomes
.html. It needs no network: mathematics is MathML, and its font lies beside the pages.
"""

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
from page_exporter import FOLDER, PageExporter, markdown

from mamttsp.course import notebooks

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
    """Write the whole site into a folder, which is emptied first."""
    shutil.rmtree(site, ignore_errors=True)
    parts = [("Notebooks", read_pages("notebooks")), ("Exercises", read_pages("notebooks/exercises"))]
    pages = [page for _, group in parts for page in group]
    for before, after in zip(pages, pages[1:]):
        before.next, after.previous = after, before
    for page in pages:
        html, _ = PageExporter().from_notebook_node(page.notebook, {"page": page})
        write(site / page.path, html)
        copy_linked_files(site, page.path, html)
    contents = jinja2.Template((FOLDER / "contents.html.j2").read_text(encoding="utf-8"), autoescape=False)
    write(site / "index.html", contents.render(parts=parts))
    shutil.copy(FOLDER / "style.css", site)
    shutil.copy(FONT, site)
    return len(pages)


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def copy_linked_files(site, path, html):
    """Copy what a page links to and is not a page: figures, rows, modules."""
    soup = BeautifulSoup(html, "html.parser")
    for link in [tag.get("href") or tag.get("src") for tag in soup.select("a[href], img[src]")]:
        url = urlsplit(link)
        source = (ROOT / path).parent / unquote(url.path)
        if not url.scheme and url.path and source.is_file():
            target = site / source.resolve().relative_to(ROOT)
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, target)


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    print(f"{build(folder)} pages, {folder / 'index.html'}")
