"""The site in headless Chromium, opened from the disk, at the width of a desk and of a phone.

The browser is looked for on the path, as chromium (`apt-get install chromium`), chromium-browser or google-chrome.
"""

import shutil

import pytest
from playwright.sync_api import sync_playwright

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
PHONE, DESK = 390, 1280
CUT = """selector => [...document.querySelectorAll(selector)]
    .filter(e => e.scrollWidth > e.clientWidth + 1 || e.getBoundingClientRect().right > innerWidth + 1)
    .map(e => e.textContent.slice(0, 80))"""
WITH_COLUMNS = ".tag_columns .cell_output pre"


@pytest.fixture(scope="module")
def browser():
    if CHROMIUM is None:
        pytest.skip("no Chromium on the path: apt-get install chromium")
    with sync_playwright() as session:
        yield session.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])


@pytest.fixture(params=[PHONE, DESK])
def page(browser, request):
    """A page that remembers in `complaints` what went wrong in it, and what it wanted from the network."""
    page = browser.new_page(viewport={"width": request.param, "height": 844})
    page.complaints = []
    page.on("console", lambda message: message.type in ("error", "warning") and page.complaints.append(message.text))
    page.on("pageerror", lambda error: page.complaints.append(str(error)))
    # what the next page interrupts has not failed
    page.on("requestfailed", lambda w: w.failure == "net::ERR_ABORTED" or page.complaints.append(w.url))
    page.on("request", lambda wanted: wanted.url.startswith(("file:", "data:")) or page.complaints.append(wanted.url))
    yield page
    page.close()


def pages_of(site):
    return sorted(path for path in site.rglob("*.html") if "_static" not in path.parts)


def test_pages_fit_and_nothing_is_cut_off(site, page):
    width = page.viewport_size["width"]
    for path in pages_of(site):
        page.goto(path.as_uri())
        assert page.evaluate("document.documentElement.scrollWidth") <= width, path
        assert page.evaluate("[...document.images].every(image => image.naturalWidth > 0)"), path
        assert not page.evaluate(CUT, f"pre:not({WITH_COLUMNS})"), path
        boxes = page.locator(WITH_COLUMNS).evaluate_all("all => all.map(e => e.getBoundingClientRect().right)")
        assert all(right <= width for right in boxes), path
        assert not page.complaints, path


@pytest.mark.parametrize("page", [DESK], indirect=True)
@pytest.mark.parametrize("name", ["notebooks/03-baseline", "notebooks/05-new-micp", "how-to/symbols"])
def test_mathematics_is_drawn(site, page, name):
    page.goto((site / f"{name}.html").as_uri())
    page.wait_for_selector("mjx-container svg")
    page.wait_for_function("document.querySelectorAll('.math:not(:has(mjx-container))').length === 0")
    drawn = page.locator("mjx-container svg").evaluate_all("all => all.map(e => e.getBoundingClientRect().width)")
    assert len(drawn) > 10 and min(drawn) > 1
    assert not page.locator("[data-mml-node=merror]").count() and not page.complaints


@pytest.mark.parametrize("name", ["04-nonconvex", "09-exact-solver"])
def test_formulas_keep_to_their_column(site, page, name):
    """At a desk all of them fit; on a phone the widest ones scroll, but reach no further than their column."""
    page.goto((site / "notebooks" / f"{name}.html").as_uri())
    page.wait_for_function("document.querySelectorAll('.math:not(:has(mjx-container))').length === 0")
    page.wait_for_selector(".math[style*=font-size]")  # the widest has been set smaller
    beyond = """selector => [...document.querySelectorAll(selector)]
        .map(e => [e, e.closest("p, li, td, dd, div:not(.math)")].map(box => box.getBoundingClientRect().right))
        .filter(([right, column]) => right > column + 1)"""
    at_a_desk = page.viewport_size["width"] == DESK
    assert not page.evaluate(beyond, ".math svg" if at_a_desk else ".math")


def test_columns_of_data_frames_stand_apart(site, page):
    page.goto((site / "notebooks" / "01-first-solve.html").as_uri())
    cells = page.locator("table.dataframe :is(th, td)")
    styles = cells.evaluate_all("all => all.map(e => getComputedStyle(e)).map(s => [s.textAlign, s.paddingLeft])")
    assert len(styles) > 50 and {align for align, _ in styles} == {"right"}
    assert min(float(room.removesuffix("px")) for _, room in styles) > 4


def test_search_finds(site, page):
    page.goto((site / "search.html").as_uri() + "?q=perspective")
    page.wait_for_selector("#search-results li a")
    page.wait_for_function("document.querySelector('.search-summary').textContent.includes('found')")
    found = page.locator("#search-results li a").all_text_contents()
    assert any("perspectives instead of big-M" in title for title in found)
    assert not page.complaints


@pytest.mark.parametrize("page", [DESK], indirect=True)
def test_the_keyboard_reaches_the_navigation(site, page):
    page.goto((site / "notebooks" / "05-new-micp.html").as_uri())
    reached, visible = [], []
    for _ in range(200):
        page.keyboard.press("Tab")
        reached.append(page.evaluate("document.activeElement.getAttribute('href') || document.activeElement.className"))
        visible.append(page.evaluate("getComputedStyle(document.activeElement).outlineStyle"))
    for wanted in ("#main-content", "../course.html", "#the-perspective-of-a-segment", "06-validity.html"):
        assert wanted in reached, wanted
    assert any("05-new-micp.ipynb" in href for href in reached)
    assert "none" not in visible[:5]
    page.keyboard.press("Control+k")
    page.wait_for_selector("dialog input[type=search]:focus")


@pytest.mark.parametrize("page", [PHONE], indirect=True)
def test_the_menu_of_a_phone_opens(site, page):
    page.goto((site / "notebooks" / "05-new-micp.html").as_uri())
    page.locator(".primary-toggle").click()
    page.wait_for_selector("dialog[open] >> text=The proof of validity")


@pytest.mark.parametrize("page", [DESK], indirect=True)
def test_dark_where_the_system_is_dark(site, page):
    page.emulate_media(color_scheme="dark")
    page.goto((site / "index.html").as_uri())
    red, green, blue = page.evaluate("getComputedStyle(document.body).backgroundColor.match(/\\d+/g).map(Number)")
    assert max(red, green, blue) < 80


@pytest.mark.parametrize("page", [DESK], indirect=True)
def test_the_film_plays(site, page):
    page.goto((site / "notebooks" / "10-playground.html").as_uri())
    picture = page.locator(".animation img")
    before = picture.get_attribute("src")
    page.locator(".anim-buttons button").last.click()
    page.locator(".anim-buttons button[title='Next frame']").click()
    assert picture.get_attribute("src") != before and not page.complaints
