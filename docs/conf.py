"""The site: `make html`, or `python -m sphinx docs site`. Notebooks are shown as they were executed; nothing is run."""

import sys
from importlib.util import find_spec
from pathlib import Path

DOCS = Path(__file__).parent
sys.path[:0] = [str(DOCS), str(DOCS.parent / "benchmarks")]

import argument_lists  # noqa: E402  (its folder is on the path only now)
import gather  # noqa: E402
import glossary_titles  # noqa: E402
import made  # noqa: E402
import notebook_pages  # noqa: E402
import question_pages  # noqa: E402

import mamttsp  # noqa: E402

project = "mamttsp"
copyright = "the mamttsp maintainers, MIT licence"
version = release = mamttsp.__version__

extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.mathjax", "sphinx_copybutton", "sphinx_design"]
default_role = "literal"  # docstrings put names between single backticks

# Markdown and notebooks
nb_execution_mode = "off"
nb_merge_streams = True
nb_ipywidgets_js = {}  # sliders need a kernel, and their scripts a network
myst_enable_extensions = ["amsmath", "colon_fence", "dollarmath", "substitution"]
myst_dmath_double_inline = True  # a display in a list needs no blank lines around it, as in Jupyter
myst_heading_anchors = 3
myst_substitutions = made.everything()

# API: as written in the code, in its order
autodoc_member_order = "bysource"
add_module_names = False
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 70

copybutton_prompt_text = ">>> "

# Mathematics: one script that needs no font and no other file
_mathjax = Path(find_spec("sphinx-mathjax-offline").origin).parent / "static" / "mathjax" / "tex-svg-full.js"
mathjax_path = _mathjax.name
mathjax3_config = {"options": {"enableMenu": False}, "svg": {"fontCache": "global", "scale": 0.95}}

html_theme = "pydata_sphinx_theme"
html_title = "mamttsp"
html_favicon = html_logo = "_static/mark.svg"
html_static_path = ["_static", str(_mathjax)]
html_css_files = ["site.css"]
html_js_files = ["from_disk.js", "formulas_fit.js"]
templates_path = ["_templates"]
html_domain_indices = False
html_sourcelink_suffix = ""  # a notebook is downloaded under its own name
_ALONE = ("index", "benchmarks", "reach", "glossary", "references", "CHANGELOG", "search", "genindex")
html_sidebars = {page: [] for page in _ALONE}
html_context = {"default_mode": "auto"}  # dark where the reader's system is
html_theme_options = {
    "logo": {"text": "mamttsp"},
    "navbar_end": ["theme-switcher"],
    "search_bar_text": "Search …",
    "secondary_sidebar_items": ["page-toc", "download-notebook"],
    "show_toc_level": 2,
    "footer_start": ["copyright"],
    "footer_end": [],
}


def plain_bars(app, what, name, obj, options, lines):
    """Docstrings say (|V|, 2) and mean no substitution."""
    lines[:] = [line.replace("|", r"\|") for line in lines]


def setup(app):
    app.connect("doctree-resolved", glossary_titles.add)
    app.connect("autodoc-process-docstring", argument_lists.add)
    app.connect("autodoc-process-docstring", plain_bars)
    app.connect("builder-inited", gather.gather)
    app.connect("source-read", notebook_pages.prepare)
    app.connect("source-read", question_pages.prepare)
