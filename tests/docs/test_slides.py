"""Slides: chosen by what a cell is, described, whole without a network, and not taller than the screen."""

import importlib.util
import re

import pytest
from bs4 import BeautifulSoup
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output
from playwright.sync_api import sync_playwright

from mamttsp.study.course import notebooks
from tests.docs.conftest import ROOT
from tests.docs.test_site_in_browser import CHROMIUM

_spec = importlib.util.spec_from_file_location("slides", ROOT / "docs" / "slides.py")
slides = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(slides)

PNG = "aGVsbG8="


def of(*cells):
    """The slides of some cells: (what kind, its text) each."""
    made = slides.slides_of(new_notebook(cells=list(cells))).cells
    return [(cell.metadata.slideshow.slide_type, cell.source) for cell in made]


def printed(text, lines=1):
    return new_code_cell("print(1)\n" * lines, outputs=[new_output("stream", text=text)])


def test_a_section_begins_with_its_heading_and_first_sentence_the_rest_is_for_the_speaker():
    assert of(new_markdown_cell("## A road\n\nOne thing. Then another.\n\nA third.")) == [
        ("slide", "## A road\n\nOne thing."),
        ("notes", "One thing. Then another.\n\nA third."),
    ]


def test_what_stands_out_is_shown_with_the_sentence_before_it():
    cell = new_markdown_cell("Much before. The flow:\n\n$$y = 1$$\n\n- a\n- b\n\nAfter.")
    assert of(cell) == [
        ("subslide", "The flow:\n\n$$y = 1$$"),
        ("subslide", "The flow:\n\n- a\n- b"),
        ("notes", "Much before. The flow:\n\nAfter."),
    ]
    assert of(new_markdown_cell("# X\n\nThe flow:\n\n$$y = 1$$"))[0] == ("slide", "# X\n\nThe flow:\n\n$$y = 1$$")


def test_a_picture_is_shown_without_code_and_with_its_words():
    cell = new_code_cell("draw()", outputs=[new_output("display_data", data={"image/png": PNG})])
    (kind, shown), (notes, words) = of(cell, new_markdown_cell("*In words:* one *agent* flies."))
    assert kind == "subslide" and f"base64,{PNG}" in shown and 'alt="one agent flies."' in shown
    assert "draw" not in shown and (notes, words) == ("notes", "one agent flies.")


def test_only_short_code_with_a_short_answer_is_shown():
    assert [kind for kind, _ in of(printed("1\n"))] == ["subslide"]
    assert of(printed("1\n" * 30)) == of(printed("1\n", lines=30)) == of(new_code_cell("a = 1")) == []


def test_links_become_words():
    assert of(new_markdown_cell("See [notebook 02](02-the-problem.ipynb).")) == [("notes", "See notebook 02.")]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("slides")
    slides.write_slides(folder)
    return folder


@pytest.fixture(scope="module")
def decks(folder):
    """The parsed pages of slides by name."""
    paths = folder.glob("[0-9]*.html")
    return {path.stem: BeautifulSoup(path.read_text(encoding="utf-8"), "html.parser") for path in paths}


def test_every_notebook_has_slides_that_are_listed_and_load_what_lies_beside_them(folder, decks):
    assert set(decks) == {path.stem for path in notebooks(ROOT / "notebooks")}
    listed = re.findall(r'href="([^"]+)"', (folder / "index.html").read_text(encoding="utf-8"))
    assert listed == [f"{name}.html" for name in sorted(decks)]
    for page in decks.values():
        loaded = [tag.get("src") or tag.get("href") for tag in page.select("script[src], link[href], img[src]")]
        files = [name for name in loaded if not name.startswith("data:")]
        assert files and all((folder / name).is_file() for name in files)
        assert "Summary" in [heading.get_text().strip("¶") for heading in page.select("section h2")]


def test_every_picture_is_described(decks):
    described = [tag.get("alt", "") for page in decks.values() for tag in page.select("section img")]
    assert len(described) > 20 and not [alt for alt in described if len(alt) < 20]


def test_in_a_browser_nothing_is_too_tall_and_nothing_comes_from_outside(folder, decks):
    if CHROMIUM is None:
        pytest.skip("no Chromium on the path: apt-get install chromium")
    complaints = []
    with sync_playwright() as session:
        browser = session.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1120, "height": 700})
        page.on("console", lambda message: message.type in ("error", "warning") and complaints.append(message.text))
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.on("request", lambda w: w.url.startswith(("file:", "data:", "blob:")) or complaints.append(w.url))
        page.on("requestfailed", lambda wanted: complaints.append(wanted.url))
        for name in sorted(decks):
            page.goto((folder / f"{name}.html").as_uri())
            page.wait_for_function("window.Reveal && Reveal.isReady() && window.MathJax && MathJax.startup.promise")
            page.evaluate("MathJax.startup.promise.then(() => 1)")
            for k in range(page.evaluate("Reveal.getTotalSlides()")):
                size = page.evaluate("(s => [s.scrollHeight, s.scrollWidth])(Reveal.getCurrentSlide())")
                assert size[0] <= 700 and size[1] <= 1120, f"{name}, slide {k + 1}: {size}"
                page.evaluate("Reveal.next()")
            assert not page.locator("[data-mml-node=merror]").count(), name
            assert not complaints, name
        browser.close()
