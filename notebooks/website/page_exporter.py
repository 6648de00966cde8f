"""A notebook as a page: nbconvert's HTML, with mathematics as MathML and links between notebooks as links of pages."""

import re
from pathlib import Path

from latex2mathml.converter import convert
from nbconvert import HTMLExporter
from nbconvert.filters.markdown_mistune import IPythonRenderer, MarkdownWithMath

FOLDER = Path(__file__).parent
IN_WORDS = "*In words:*"


def formula(tex, display="inline"):
    r"""Return TeX as MathML; what the converter would not read well is written as it likes it, and so is its result.

    A tag gets room before it, the letter after \mathcal and its like braces, and large braces lose their backslash.
    """
    tex = re.sub(r"\\tag\{(.*?)\}", r"\\qquad\\text{(\1)}", tex)
    mathml = convert(re.sub(r"(\\math[a-z]+)\s+(\w)", r"\1{\2}", tex), display=display)
    return re.sub(r">\\([{}|])<", lambda found: f">{found[1].replace('|', '‖')}<", mathml)


class PageRenderer(IPythonRenderer):
    """Markdown to HTML. Browsers draw MathML themselves, so a page needs no script."""

    def inline_math(self, body):
        return formula(body)

    def block_math(self, body):
        return f'<span class="formula">{formula(body, display="block")}</span>'

    def latex_environment(self, name, body):
        return self.block_math(rf"\begin{{{name}}}{body}\end{{{name}}}")

    def link(self, text, url, title=None):
        """Link to the page of a notebook or a text; links out of the site stay as they are."""
        return super().link(text, re.sub(r"^(?![a-z]+:)([^#]*)\.(ipynb|md)(?=#|$)", r"\1.html", url), title)


def markdown(source):
    """Return Markdown as HTML."""
    return MarkdownWithMath(renderer=PageRenderer(escape=False, exclude_anchor_links=True)).render(source)


class PageExporter(HTMLExporter):
    """Fills index.html.j2 in this folder; `resources["page"]` says which page it is."""

    def __init__(self):
        super().__init__(template_name=FOLDER.name, extra_template_basedirs=[str(FOLDER.parent)])

    def default_filters(self):
        yield from super().default_filters()
        yield "markdown2html", markdown

    def from_notebook_node(self, nb, resources=None, **kw):
        """Export a notebook whose pictures are described by the sentence below them."""
        for cell, below in zip(nb.cells, nb.cells[1:]):
            if below.source.startswith(IN_WORDS):
                cell.metadata["alt"] = re.sub(r"[*$`]", "", below.source.removeprefix(IN_WORDS)).strip()
        return super().from_notebook_node(nb, resources, **kw)
