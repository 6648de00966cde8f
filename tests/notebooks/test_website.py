"""The website of the notebooks is whole and needs nothing from outside; no browser is needed to see that."""

import re
from urllib.parse import unquote, urlsplit

import pytest
from bs4 import BeautifulSoup
from notebooks.running import NOTEBOOKS, ROOT

from mamttsp.study.course import notebooks

SOURCES = "img[src], script[src], iframe[src], source[src], video[src], audio[src], link[href]"


@pytest.fixture(scope="session")
def pages(site):
    """Each page's parsed text by its path in the site."""
    paths = site.rglob("*.html")
    return {path.relative_to(site): BeautifulSoup(path.read_text(encoding="utf-8"), "html.parser") for path in paths}


def test_every_notebook_has_a_page_and_the_contents_link_all_pages(site, pages):
    sheets = notebooks(ROOT / "notebooks" / "exercises")
    expected = {path.relative_to(ROOT).with_suffix(".html").as_posix() for path in [*NOTEBOOKS, *sheets]}
    assert {path.as_posix() for path in pages} >= expected | {"index.html"}
    contents = next(page for path, page in pages.items() if path.name == "index.html")
    assert {link["href"] for link in contents.select("a[href]")} == expected


def test_all_links_lead_somewhere(site, pages):
    for path, page in pages.items():
        for link in page.select("a[href], " + SOURCES):
            url = urlsplit(link.get("href") or link.get("src"))
            if not url.scheme:
                target = (site / path.parent / unquote(url.path)).resolve() if url.path else site / path
                assert target.is_file(), f"{path}: {link}"
                there = pages.get(target.relative_to(site.resolve()))
                assert not url.fragment or there.find(id=unquote(url.fragment)), f"{path}: {link}"


def test_nothing_is_loaded_from_outside(site, pages):
    loaded = [tag.get("src") or tag.get("href") for page in pages.values() for tag in page.select(SOURCES)]
    styles = [tag.get_text() for page in pages.values() for tag in page.select("style")]
    styles.append((site / "style.css").read_text(encoding="utf-8"))
    in_styles = re.findall(r"(?:url\(|@import )\s*[\"']?([^\"')\s]+)", " ".join(styles))
    assert loaded and in_styles
    assert not [url for url in loaded + in_styles if urlsplit(url).netloc or urlsplit(url).scheme not in ("", "data")]


def test_mathematics_is_mathml_with_a_font_beside_it(site, pages):
    for path, page in pages.items():
        unread = [tag for tag in page.select("math mo, math mi, math mtext") if re.search(r"\\.", tag.get_text())]
        # browsers draw script and bold letters only where these are letters of their own
        assert not unread and not page.select("mi[mathvariant]:not([mathvariant=normal])"), path
        for code in page.select("pre, code, script, style"):
            code.decompose()
        assert not re.search(r"\$|\\[a-z]+\{|\\\(", page.get_text()), path
    assert sum(len(page.select("math")) for page in pages.values()) > 100
    assert (site / "STIXTwoMath-Regular.ttf").is_file()


def test_every_picture_is_described(pages):
    described = [tag.get("alt", "") for page in pages.values() for tag in page.select("img")]
    # nbconvert's own words for a picture without a description
    assert described and not [alt for alt in described if len(alt) < 20 or alt.startswith("No description")]


def test_solutions_are_folded(pages):
    exercises = [page for path, page in pages.items() if path.parent.name == "exercises" and path.stem != "README"]
    folded = [page.select("details:not([open]) .input_area") for page in exercises]
    assert folded and all(folded)
