"""The site is whole and needs nothing from outside; no browser is needed to see that."""

import re
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pandas as pd
import pytest
from bs4 import BeautifulSoup
from PIL import Image

import mamttsp
from mamttsp.formulations import build_formulation
from mamttsp.study.course import notebooks, read_questions
from tests.docs.conftest import ROOT

LOADED = "img[src], script[src], iframe[src], source[src], video[src], audio[src], link[href]"
FIRST = Path("index.html")
NOTEBOOKS = [*notebooks(ROOT / "notebooks"), *notebooks(ROOT / "notebooks" / "exercises")]


@pytest.fixture(scope="session")
def pages(site):
    """Each page's parsed text by its path in the site."""
    paths = (path for path in site.rglob("*.html") if "_static" not in path.parts)  # there are templates of the theme
    return {path.relative_to(site): BeautifulSoup(path.read_text(encoding="utf-8"), "html.parser") for path in paths}


def test_every_notebook_has_a_page_with_contents_neighbours_and_itself_to_download(site, pages):
    for notebook in NOTEBOOKS:
        path = notebook.relative_to(ROOT).with_suffix(".html")
        page = pages[path]
        assert page.select(".page-toc a"), path
        assert page.select(".prev-next-area a"), path
        download = page.select_one("a.download-notebook[download]")
        assert (site / path.parent / unquote(download["href"])).read_bytes() == notebook.read_bytes()


def test_all_links_lead_somewhere(site, pages):
    for path, page in pages.items():
        for link in page.select("a[href], " + LOADED):
            url = urlsplit(link.get("href") or link.get("src"))
            if not url.scheme:
                target = (site / path.parent / unquote(url.path)).resolve() if url.path else (site / path).resolve()
                assert target.is_file(), f"{path}: {link}"
                there = pages.get(target.relative_to(site.resolve()))
                assert not url.fragment or there.find(id=unquote(url.fragment)), f"{path}: {link}"


def test_nothing_is_loaded_from_outside(site, pages):
    loaded = [tag.get("src") or tag.get("href") for page in pages.values() for tag in page.select(LOADED)]
    styles = [tag.get_text() for page in pages.values() for tag in page.select("style")]
    styles += [path.read_text(encoding="utf-8") for path in site.rglob("*.css")]
    in_styles = re.findall(r"(?:url\(|@import )\s*[\"']?([^\"')\s]+)", " ".join(styles))
    assert loaded and in_styles
    assert not [url for url in loaded + in_styles if urlsplit(url).netloc or urlsplit(url).scheme not in ("", "data")]


def test_links_that_leave_the_site_say_so(site, pages):
    outward = [link for page in pages.values() for link in page.select("a[href]") if urlsplit(link["href"]).netloc]
    assert outward and not [link for link in outward if "external" not in link.get("class", [])]
    assert "a.external" in (site / "_static" / "site.css").read_text(encoding="utf-8")


def test_every_picture_is_described(pages):
    described = [tag.get("alt", "") for page in pages.values() for tag in page.select("article img")]
    assert described and not [alt for alt in described if len(alt) < 20]


def test_the_first_picture_moves_and_is_small(site, pages):
    path = site / pages[FIRST].select_one("article img")["src"]
    with Image.open(path) as picture:
        assert picture.n_frames > 20
    assert path.stat().st_size < 1_000_000


def test_solutions_are_folded(pages):
    exercises = [page for path, page in pages.items() if path.parent.name == "exercises" and path.stem[0].isdigit()]
    folded = [page.select("details:not([open]) .cell_input, details:not([open]) .highlight") for page in exercises]
    assert folded and all(folded)


def test_questions_stand_above_their_hints_and_folded_solutions(pages):
    answers = [page for path, page in pages.items() if path.parent.name == "questions" and path.stem != "README"]
    quoted = [quote.get_text() for page in answers for quote in page.select("section blockquote")]
    asked = [text for path in notebooks(ROOT / "notebooks") for text in read_questions(path).values()]
    assert len(quoted) == len(asked) == sum(len(page.select("details:not([open]) summary")) for page in answers)
    assert all(quoted)


def test_every_public_name_is_in_the_reference(pages):
    api = [page for path, page in pages.items() if path.parent.name == "api"]
    documented = {tag["id"].removeprefix("module-") for page in api for tag in page.select("dt[id], [id^=module-]")}
    assert {f"mamttsp.{name}" for name in mamttsp.__all__} - documented == set()


def test_the_names_of_sets_and_data_are_those_of_the_code():
    instance = mamttsp.paper_instance(5, 0)
    graph = mamttsp.build_graph(instance)
    homes = {"graph": graph, "m": build_formulation("baseline", "pyomo", graph, 1).model}
    text = (ROOT / "docs" / "how-to" / "symbols.md").read_text(encoding="utf-8")
    names = re.findall(r"`(graph|m)\.(\w+)", text)
    assert len(names) > 10 and not [name for home, name in names if not hasattr(homes[home], name)]


def test_tables_and_sentences_come_from_rows(pages):
    settings = len(pd.read_csv(ROOT / "paper_results" / "exact.csv"))
    assert f"of {settings} problems by the paper" in " ".join(pages[FIRST].get_text().split())
    beyond = pd.read_csv(ROOT / "paper_results" / "scale.csv")
    rows = pages[Path("reach.html")].select_one("table").select("tbody tr")
    assert len(rows) == len(beyond) and "gap (%)" in pages[Path("reach.html")].get_text()
    assert len(pages[Path("benchmarks.html")].select("table")) == 4
    assert not [path for path, page in pages.items() if "{{ " in "".join(a.get_text() for a in page.select("article"))]


def test_how_mathematics_is_set_is_beside_the_pages(site, pages):
    with_formulas = [page for page in pages.values() if page.select(".math")]
    assert len(with_formulas) > 10
    assert all(page.select("script[src*='tex-svg-full.js']") for page in with_formulas)
    assert (site / "_static" / "tex-svg-full.js").is_file()


def test_no_mathematics_is_left_as_text(pages):
    """A dollar in prose is a formula that was not understood, and the words up to the next dollar are set as one."""
    articles = [(path, article) for path, page in pages.items() for article in page.select("article")]
    dollars = [(path, text) for path, article in articles for text in article.find_all(string=re.compile(r"\$"))]
    assert articles and not [(path, text) for path, text in dollars if not _is_literal(text)]


def _is_literal(text):
    names = ("code", "pre", "script", "style")
    return any(tag.name in names or "math" in tag.get("class", []) for tag in text.parents)


def test_terms_lead_to_the_glossary_and_show_what_they_mean(pages):
    glossary = pages[Path("glossary.html")]
    assert len(glossary.select("dt[id^=term-]")) > 40
    links = pages[Path("notebooks/01-first-solve.html")].select("a[href*='glossary.html#term-']")
    assert len(links) >= 5
    for link in links:
        term = glossary.find(id=link["href"].partition("#")[2])
        assert link["title"] == " ".join(term.find_next("dd").get_text().split())
