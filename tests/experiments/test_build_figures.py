"""All figures from a folder of rows: what is drawn, what the titles say, and one line for what is wrong."""

import json
import re
import shutil
from pathlib import Path

import matplotlib.pyplot as plt
import pandas as pd
import pytest

from mamttsp import paper_instance, solve
from mamttsp.__main__ import main
from mamttsp.experiments import build_figures as building
from mamttsp.experiments import profile
from mamttsp.experiments.sheets import open_sheets, paper_sheets
from mamttsp.experiments.summaries.row_statistics import read_table
from tests.experiments.made_up_rows import EXACT, solved, stopped, write_rows

PUBLISHED = Path(__file__).parents[2] / "paper_results" / "published.csv"
NAMES = ["paper-fig-2-published", "paper-fig-3-published", "paper-fig-1", "paper-fig-2-ours", "paper-fig-3-ours"]
NAMES += ["paper-fig-2-open", "paper-fig-3-open"]
NAMES += ["experiments-cactus", "experiments-profile", "experiments-true-gaps"]


@pytest.fixture(autouse=True)
def close_figures():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def three_agents():
    """A row with the optimum of an instance of three agents, one of which stays at the depot."""
    solution = solve(paper_instance(10, 0, 40, 3))
    tours = json.dumps([tour.to_dict() for tour in solution.tours])
    return solved(1.0, solution.objective, **EXACT | {"n": 10, "agents": 3, "tours": tours})


@pytest.fixture
def folder(tmp_path, three_agents):
    return _fill(tmp_path, three_agents)


def _fill(folder, three_agents):
    """Write rows of n = 5 on SCIP, all but one, and exact rows of two of these instances."""
    runs = [run for run in profile("reduced") if run.n == 5 and run.solver == "scip"]
    keys = [{name: getattr(run, name) for name in ("index", "total_window", "agents", "method")} for run in runs]
    micp, base = ([key for key in keys if key["method"] == method] for method in ("micp", "baseline"))
    rows = [solved(2.0, **key) for key in micp[:-1]] + [stopped(110.0, 90.0, **key) for key in base[:-1]]
    others = [solved(9.0, modeler="cvxpy"), solved(9.0, time_limit=600)]  # of another campaign
    rows += [solved(1.0, solver="clarabel", modeler="cvxpy", **key) for key in micp]
    write_rows(folder / "reduced.csv", [*rows, stopped(None, 10.0, **base[-1]), *others])
    write_rows(folder / "claims_runs.csv", [])
    write_rows(folder / "exact.csv", [three_agents, solved(0.5, **EXACT), solved(0.5, **EXACT | {"total_window": 20})])
    shutil.copy(PUBLISHED, folder)
    (folder / "out").mkdir()
    return folder


@pytest.fixture(scope="module")
def drawn(tmp_path_factory, three_agents):
    """Build with a camera that looks at the figures instead of writing them: name to figure."""
    plt.close("all")  # of other tests
    folder, figures = _fill(tmp_path_factory.mktemp("rows"), three_agents), {}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(building, "save", lambda ax, path, dpi: figures.update({path.name: ax.figure}))
        list(building.build(folder, folder / "out"))
    assert not plt.get_fignums()
    return figures


def _caption(figure):
    """Return what stands below a figure, its lines joined."""
    (caption,) = figure.texts
    return caption.get_text().replace("\n", " ")


def test_every_figure_is_drawn(drawn):
    assert list(drawn) == NAMES


@pytest.mark.parametrize("name", NAMES)
def test_it_is_as_wide_as_a_column_and_all_that_is_written_is_on_it_and_can_be_read(drawn, name):
    figure = drawn[name]
    assert figure.get_figwidth() == 3.5
    figure.draw_without_rendering()
    width = figure.bbox.width + 1  # a pixel for rounding
    extents = {text.get_text(): text.get_window_extent() for text in _words(figure) if text.get_text()}
    assert not [text for text, extent in extents.items() if extent.x0 < -1 or extent.x1 > width]
    assert min(text.get_fontsize() for text in _words(figure)) >= 5.5


def _words(figure):
    """Return titles, labels, notes and legends: all that is written but the numbers of the axes."""
    legends = [*figure.legends, *(ax.get_legend() for ax in figure.axes if ax.get_legend())]
    words = [*figure.texts, *(text for legend in legends for text in (legend.get_title(), *legend.get_texts()))]
    return words + [text for ax in figure.axes for text in (ax.title, ax.xaxis.label, ax.yaxis.label, *ax.texts)]


def test_figure_1_has_three_agents_and_one_is_idle(drawn):
    legend = [text.get_text() for text in drawn["paper-fig-1"].axes[0].get_legend().get_texts()]
    assert [re.sub(r" \d+ s$", "", label) for label in legend if "tour" in label or "agent" in label] == [
        "tour 0, back at",
        "tour 1, back at",
        "1 idle agent",
    ]


@pytest.mark.parametrize("number, n_panels", [(2, 3), (3, 4)])
def test_published_and_ours_have_the_same_panels_and_say_what_they_are(drawn, number, n_panels):
    published, ours = (drawn[f"paper-fig-{number}-{whose}"] for whose in ("published", "ours"))
    panels = [[ax.get_title() for ax in figure.axes if ax.get_title()] for figure in (published, ours)]
    assert panels[0] == panels[1] and len(panels[0]) == n_panels
    part = {2: "one agent", 3: "windows of 40 s"}[number]
    titles = [figure.legends[0].get_title().get_text() for figure in (published, ours)]
    assert titles == [f"Published: {part}", f"Ours: {part}"]
    assert "Gurobi 10.0.3, limit 1800 s, Intel i7-7700HQ; means of 20 instances" in _caption(published)
    assert "scip 10.0, limit 60 s, threads 1, a laptop; means of 5 instances" in _caption(ours)


@pytest.mark.parametrize("whose", ["published", "ours"])
def test_all_panels_of_both_figures_have_one_scale(drawn, whose):
    panels = [ax for number in (2, 3) for ax in drawn[f"paper-fig-{number}-{whose}"].axes if ax.get_title()]
    assert len(panels) == 7 and len({ax.get_ylim() for ax in panels}) == 1 and panels[0].get_yscale() == "log"


def test_the_figures_can_be_drawn_from_rows_of_other_routes():
    rows = pd.DataFrame(
        [
            (40, m, 5, route, time, 0.0)
            for m in (1, 2)
            for route, time in (("micp/clarabel", 0.05), ("baseline/scip", 600.0))
        ],
        columns=["total_window_s", "agents", "targets", "formulation", "runtime_s", "gap_percent"],
    )
    sheets = dict(paper_sheets(rows, "open", "Best open routes", lambda bars: f"{len(bars)} bars"))
    assert list(sheets) == ["paper-fig-2-open", "paper-fig-3-open"]
    for ax in sheets.values():
        (legend,) = ax.figure.legends
        assert legend.get_title().get_text().startswith("Best open routes: ") and _caption(ax.figure) == "2 bars"
        assert [text.get_text() for text in legend.get_texts()] == ["baseline, SCIP", "MICP, Clarabel"]
        assert [bar.get_height() for bar in ax.patches] == [600.0, 0.05] and ax.get_ylim()[0] == 0.01


def test_the_open_figures_say_of_how_many_instances_each_mean_may_be():
    """The campaign "claims" has five instances of 15 targets and three of 20, "reduced" has five of each size."""
    reduced, longer = (read_table(PUBLISHED.with_name(name)) for name in ("reduced.csv", "claims_runs.csv"))
    for ax in dict(open_sheets(reduced, longer)).values():
        assert "limit 60 and 600 s" in _caption(ax.figure) and "; means of 3 and 5 instances. " in _caption(ax.figure)


def test_ours_says_how_many_bars_are_missing_and_shows_which(drawn):
    figure = drawn["paper-fig-3-ours"]
    assert "7 of 32 bars have all their rows" in _caption(figure) and "1 without tours at 100 % gap" in _caption(figure)
    assert "6 of 24 bars have all their rows" in _caption(drawn["paper-fig-2-ours"])
    by_panel = {ax.get_title(): len(ax.patches) for ax in figure.axes if ax.get_title()}
    assert by_panel == {"(a) 2 agents": 2, "(b) 3 agents": 2, "(c) 4 agents": 2, "(d) 5 agents": 1}
    assert [bar.get_height() for bar in figure.axes[0].patches] == [2.0, 60.0]  # a run at its limit counts at it


def test_methods_are_compared_on_the_instances_that_all_have(drawn):
    assert "2 instances with a row of every method" in _caption(drawn["experiments-cactus"])
    assert "limit 60 s" in _caption(drawn["experiments-profile"])
    assert "4 of 69 runs have a certified optimum" in _caption(drawn["experiments-true-gaps"])


def test_relaxed_bounds_are_drawn_if_there_are_any(folder, monkeypatch):
    figures = {}
    monkeypatch.setattr(building, "save", lambda ax, path, dpi: figures.update({path.name: ax.figure}))
    shutil.copy(PUBLISHED.with_name("predecessor.csv"), folder)
    relaxed = {"modeler": "cvxpy", "solver": "clarabel", "time_limit": None, "status": "relaxed", "objective": None}
    rows = [{"method": "micp", "bound": 80.0}, {"method": "baseline", "bound": 0.0}, {"index": 7, "bound": 9.0}]
    write_rows(folder / "relaxations.csv", [solved(1.0, **relaxed | row) for row in rows])
    list(building.build(folder, folder / "out"))
    figure = figures["experiments-relaxations"]
    assert _caption(figure) == "2 of 3 relaxations have a certified optimum. scip 10.0, threads 1, a laptop."
    drawn = [{line.get_label(): list(line.get_ydata()) for line in ax.lines} for ax in figure.axes]
    assert drawn[0] == {"MICP, windows of 40 s": [0.8], "baseline, all": [0.0]}
    assert drawn[1] == {"MICP, 1 agent": [0.8], "baseline, all": [0.0]}
    assert drawn[2]["MICP, windows of 50 s"] == [0.78, 0.63, 0.61, 0.54]


def _one_line(capsys):
    err = capsys.readouterr().err
    assert err.count("\n") == 1 and "Traceback" not in err
    return err


def _command(folder):
    return main(["figures", "--results", str(folder), "--out", str(folder / "out")])


def test_the_command_draws_what_it_can_and_names_the_file_that_is_missing(folder, capsys):
    (folder / "exact.csv").unlink()
    assert _command(folder) == 2
    assert "exact.csv: cannot be read: No such file" in _one_line(capsys)
    written = sorted(path.name for path in (folder / "out").iterdir())
    assert written == [f"paper-fig-{number}-published.{kind}" for number in (2, 3) for kind in ("pdf", "png")]


@pytest.mark.parametrize(
    "content, words",
    [
        (b"figure,agents\n2a,1\n", "expected the columns figure, total_window_s"),
        (b"", "No columns"),
        (b"\xff\xfe\x00", "cannot be read"),
        (b'a,b\n1,2,3\n"', "cannot be read"),
    ],
)
def test_a_published_file_that_is_another_file_is_refused(folder, capsys, content, words):
    (folder / "published.csv").write_bytes(content)
    assert _command(folder) == 2
    err = _one_line(capsys)
    assert "published.csv: " in err and words in err


def test_rows_of_another_version_are_refused(folder, capsys, monkeypatch):
    monkeypatch.setattr(building, "save", lambda ax, path, dpi: None)
    (folder / "reduced.csv").write_text("n,index\n5,0\n")
    assert _command(folder) == 2
    assert "reduced.csv: columns of another version" in _one_line(capsys)


def test_figure_1_needs_an_optimum_that_leaves_an_agent_idle(folder, capsys, monkeypatch):
    monkeypatch.setattr(building, "save", lambda ax, path, dpi: None)
    write_rows(folder / "exact.csv", [solved(0.5, **EXACT)])
    assert _command(folder) == 2
    assert "exact.csv: no row with n 10, total_window 40, agents 3" in _one_line(capsys)


def test_no_folder_for_the_figures(folder, capsys):
    (folder / "out").rmdir()
    assert _command(folder) == 2 and "out: there is no such folder" in _one_line(capsys)


def test_a_figure_that_cannot_be_written(folder, capsys):
    (folder / "out" / "paper-fig-2-published.pdf").mkdir()
    assert _command(folder) == 2
    assert "paper-fig-2-published.pdf: cannot be written: Is a directory" in _one_line(capsys)
