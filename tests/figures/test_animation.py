"""A moment shows who is where, and a film is a page that needs neither a kernel nor the network."""

import base64
import io
import re
import shutil

import matplotlib.pyplot as plt
import pytest
from PIL import Image

from mamttsp import InputError, Solution, Tour, Visit
from mamttsp.figures import COLOURS, film, moment_view
from mamttsp.figures.recording import few_colours
from tests.examples import instance, moving, still

INSTANCE = instance(moving((10, 0), (0, 0.2), [(5, 15), (30, 50)]), still(0, 20, [(0, 60)]), n_agents=2)
TOURS = [Tour((Visit(0, 10.0, (10.0, 2.0)), Visit(1, 20.0, (0.0, 20.0))), 30.0)]


@pytest.fixture(autouse=True)
def close_figures():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def page(short_film):
    return short_film._repr_html_()


@pytest.fixture(scope="module")
def short_film():
    return film(INSTANCE, TOURS, step=14.0)


def _line(ax, **wanted):
    """Return the corners of the lines with these properties, one list each."""
    found = [
        line for line in ax.lines if all(getattr(line, f"get_{name}")() == value for name, value in wanted.items())
    ]
    return [line.get_xydata().tolist() for line in found]


def test_an_agent_has_flown_part_of_its_tour():
    ax = moment_view(INSTANCE, TOURS, 15.0)
    assert _line(ax, color=COLOURS[0], linestyle="-") == [[[0, 0], [10, 2], [5, 11]]]
    assert _line(ax, label="tour 0") == [[[5, 11]]]
    assert ax.get_title() == "15 s: 1 of 2 targets visited"


def test_an_agent_that_is_back_stays_at_the_depot():
    assert _line(moment_view(INSTANCE, TOURS, 90.0), label="tour 0") == [[[0, 0]]]


@pytest.mark.parametrize("time, filled", [(3.0, False), (8.0, True), (20.0, False), (40.0, True)])
def test_a_target_is_filled_while_a_window_is_open(time, filled):
    (dot,) = [
        line for line in moment_view(INSTANCE, [], time).lines if line.get_xydata().tolist() == [[10, 0.2 * time]]
    ]
    assert (dot.get_markerfacecolor() != "white") == filled


def test_a_visited_target_is_gone():
    assert [text.get_text() for text in moment_view(INSTANCE, TOURS, 9.0).texts] == ["0", "1"]
    assert [text.get_text() for text in moment_view(INSTANCE, TOURS, 10.0).texts] == ["1"]


def test_it_draws_on_the_axes_it_is_given():
    ax = plt.figure().add_subplot()
    assert moment_view(INSTANCE, TOURS, 1.0, ax=ax) is ax and len(plt.get_fignums()) == 1


def test_a_film_shows_every_moment_until_the_last_agent_is_back(page):
    frames = re.findall(r'frames\[\d\] = "data:image/png;base64,([^"]+)"', page)
    assert len(frames) == 4  # 0, 14, 28 and 42 s
    pictures = [Image.open(io.BytesIO(base64.b64decode(frame))).convert("RGB") for frame in frames]
    assert len({picture.tobytes() for picture in pictures}) == 4
    assert {picture.size for picture in pictures} == {(432, 388)}


def test_a_film_is_the_same_each_time(page):
    assert film(INSTANCE, TOURS, step=14.0).html == page
    assert film(INSTANCE, TOURS, step=15.0).html.split("_anim_img")[1][:12] != page.split("_anim_img")[1][:12]


def test_a_film_needs_nothing_from_elsewhere(page):
    assert "<link" not in page and "//" not in re.sub(r"base64,[^\"]*", "", re.sub(r"\s// .*", "", page))
    assert "fa-" not in page and page.count("<button") == 9 and "▶" in page


def test_a_film_has_a_picture_where_scripts_are_off(page):
    first = re.search(r'<img alt="[^"]+" style="[^"]+" src="([^"]+)"', page)[1]
    assert f'frames[0] = "{first}"' in page


def test_a_film_of_nobody_is_one_picture():
    page = film(INSTANCE, []).html
    assert len(re.findall(r"frames\[\d+\] =", page)) == 1
    assert plt.get_fignums() == []


def test_a_solution_is_filmed_as_its_tours_are(page):
    solution = Solution("feasible", 50.0, None, 1.0, tuple(TOURS), "exact", "none")
    assert film(INSTANCE, solution, step=14.0).html == page


@pytest.mark.parametrize(
    "instance, tours, step, message",
    [({}, TOURS, 3, "instance: expected"), (INSTANCE, 3, 3, "tours: expected"), (INSTANCE, TOURS, 0, "step: expected")],
)
def test_what_cannot_be_filmed_is_refused_in_one_line(instance, tours, step, message):
    with pytest.raises(InputError, match=message):
        film(instance, tours, step)


def test_a_gif_has_every_picture_and_goes_round(short_film, tmp_path):
    short_film.save(tmp_path / "tours.gif")
    with Image.open(tmp_path / "tours.gif") as gif:
        assert (gif.format, gif.n_frames, gif.size, gif.info["loop"]) == ("GIF", 4, (432, 388), 0)
        assert gif.info["duration"] in (120, 125)  # GIF counts hundredths
        shown = []
        for k in range(gif.n_frames):
            gif.seek(k)
            shown.append(gif.convert("RGB").tobytes())
    assert len(set(shown)) == 4 and gif.info["duration"] == 2000


def test_the_page_is_a_file_too(short_film, page, tmp_path):
    short_film.save(tmp_path / "tours.html")
    assert (tmp_path / "tours.html").read_text(encoding="utf-8") == page


@pytest.fixture
def stand_in(tmp_path, monkeypatch):
    """A program ffmpeg that writes what it is given; made by hand, so that the test runs where ffmpeg is not."""

    def write(script):
        (tmp_path / "bin").mkdir()
        program = tmp_path / "bin" / "ffmpeg"
        program.write_text(f"#!/bin/sh\n{script}\n")
        program.chmod(0o755)
        monkeypatch.setenv("PATH", f"{program.parent}:/usr/bin:/bin")

    return write


def test_mp4_is_made_by_ffmpeg_of_all_pictures(short_film, stand_in, tmp_path):
    stand_in(f'echo "$@" > {tmp_path}/arguments; cat > {tmp_path}/pictures')
    short_film.save(tmp_path / "tours.mp4")
    arguments = (tmp_path / "arguments").read_text().split()
    assert arguments[-1] == str(tmp_path / "tours.mp4") and "yuv420p" in arguments
    assert (tmp_path / "pictures").read_bytes().count(b"\x89PNG") == 4


def test_why_ffmpeg_failed_is_one_line(short_film, stand_in, tmp_path):
    stand_in("cat > /dev/null; echo 'no room' >&2; echo 'left' >&2; exit 1")
    with pytest.raises(InputError, match="tours.mp4: ffmpeg failed: no room left"):
        short_film.save(tmp_path / "tours.mp4")


def test_without_ffmpeg_mp4_is_refused(short_film, monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(InputError, match=r"tours.mp4: .mp4 needs the program ffmpeg"):
        short_film.save(tmp_path / "tours.mp4")


@pytest.mark.skipif(shutil.which("ffmpeg") is None, reason="the program ffmpeg is not installed")
def test_ffmpeg_makes_a_film_that_it_can_read(short_film, tmp_path):
    short_film.save(tmp_path / "tours.mp4")
    assert (tmp_path / "tours.mp4").read_bytes()[4:8] == b"ftyp"


@pytest.mark.parametrize(
    "name, message", [("tours.avi", "a film is saved as"), ("no/folder/tours.gif", "cannot be written")]
)
def test_a_film_that_cannot_be_saved_is_refused_in_one_line(name, message, short_film, tmp_path):
    with pytest.raises(InputError, match=f"{name}: {message}"):
        short_film.save(tmp_path / name)


def test_a_film_names_the_unit_of_lengths():
    in_km, in_units = (film(INSTANCE, TOURS, step=40.0, **unit).frames[-1] for unit in ({"unit": "km"}, {}))
    for frame, unit in ((in_km, {"unit": "km"}), (in_units, {})):
        ax = plt.figure(figsize=(6, 5.4), dpi=72).add_subplot()
        drawn = io.BytesIO()
        moment_view(INSTANCE, TOURS, 40.0, ax, **unit).figure.savefig(drawn, dpi=72)
        assert _pixels(drawn.getvalue()) == _pixels(frame)
    assert _pixels(in_km) != _pixels(in_units)


def _pixels(picture):
    return few_colours(Image.open(io.BytesIO(picture))).convert("RGB").tobytes()
