"""The drawings hold what they say: each path, window, tour, visit and agent, where it belongs."""

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.colors import to_hex

from mamttsp import InputError, Solution, Tour, Visit, build_graph, plot
from mamttsp.figures import (
    COLOURS,
    LINES,
    MARKERS,
    charge_view,
    descent_view,
    graph_view,
    moment_view,
    perspective_view,
    plan_view,
    reach_view,
    save,
    sizes_view,
    space_time_view,
)
from tests.examples import agents, general, instance, moving, still

INSTANCE = instance(moving((10, 0), (0, 0.2), [(5, 15), (30, 50)]), still(0, 20, [(0, 60)]), n_agents=3)
TOURS = [Tour((Visit(0, 10.0, (10.0, 2.0)), Visit(1, 20.0, (0.0, 20.0))), 30.0)]
VIEWS = (plan_view, space_time_view)


@pytest.fixture(autouse=True)
def close_figures():
    yield
    plt.close("all")


def _legend(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def _lines(ax, colour):
    """Return the corners of the lines of a colour, (x, y) or (x, y, t) each."""
    lines = [line for line in ax.lines if line.get_color() == colour and line.get_linestyle() != "None"]
    return [np.column_stack(line.get_data_3d() if hasattr(line, "get_data_3d") else line.get_data()) for line in lines]


@pytest.mark.parametrize("view", VIEWS)
def test_the_legend_names_everything_once_and_idle_agents_too(view):
    expected = ["target's path", "time window", "tour 0, back at 30 s", "depot", "2 idle agents"]
    assert _legend(view(INSTANCE, TOURS)) == expected


UNLIKE = general(
    *INSTANCE.targets, types=[agents(2), agents(1, (30.0, 0.0), 8.0, end=(0.0, 0.0)), agents(1, end=(9.0, 9.0))]
)


@pytest.mark.parametrize("view", VIEWS)
def test_depots_ends_and_tours_of_types_are_told_apart(view):
    tours = [Tour(TOURS[0].visits, 30.0, agent=1)]
    ax = view(UNLIKE, tours)
    places = ["depot of type 0, 2", "depot of type 1", "end of type 1", "end of type 2"]
    assert _legend(ax) == ["target's path", "time window", "tour 0 (type 1), back at 30 s", *places, "3 idle agents"]
    (flown,) = _lines(ax, COLOURS[0])
    assert flown[[0, -1], :2].tolist() == [[30.0, 0.0], [0.0, 0.0]]
    with pytest.raises(InputError, match="agent None is not one of the 3 types"):
        view(UNLIKE, TOURS)


@pytest.mark.parametrize("view", VIEWS)
def test_an_empty_tour_is_an_idle_agent(view):
    expected = ["tour 1, back at 30 s", "depot", "1 idle agent"]
    assert _legend(view(INSTANCE.with_agents(2), [Tour((), 0.0), *TOURS]))[2:] == expected


@pytest.mark.parametrize("view", VIEWS)
def test_a_solution_is_drawn_as_its_tours_are(view):
    solution = Solution("feasible", 50.0, None, 1.0, tuple(TOURS), "exact", "none")
    drawn, expected = (_lines(view(INSTANCE, tours), COLOURS[0]) for tours in (solution, TOURS))
    assert [line.tolist() for line in drawn] == [line.tolist() for line in expected] != []


@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("tours", [3, "tours", TOURS[0], [3], {}, [Tour((3,), 1.0)]])
def test_what_is_no_tours_is_refused_in_one_line(view, tours):
    with pytest.raises(InputError, match=r"^tours.*: expected a .*found [^\n]*\Z"):
        view(INSTANCE, tours)


@pytest.mark.parametrize("view", VIEWS)
def test_what_is_no_instance_is_refused_in_one_line(view):
    with pytest.raises(InputError, match=r"^instance: expected Instance, found dict \{\}\Z"):
        view({})


@pytest.mark.parametrize("view, projection", [(plan_view, None), (space_time_view, "3d")])
def test_it_draws_on_the_axes_it_is_given(view, projection):
    ax = plt.figure().add_subplot(projection=projection)
    assert view(INSTANCE, TOURS, ax=ax) is ax
    assert len(plt.get_fignums()) == 1


def test_the_plan_shows_windows_and_tours_where_they_are():
    ax = plan_view(INSTANCE, TOURS)
    windows = [line.tolist() for line in _lines(ax, "#F5C45E")]
    assert windows == [[[10, 1], [10, 3]], [[10, 6], [10, 10]], [[0, 20], [0, 20]]]
    assert _lines(ax, COLOURS[0])[0].tolist() == [[0, 0], [10, 2], [0, 20], [0, 0]]
    labels = {text.get_text(): text.xy for text in ax.texts}
    assert labels == {"0: 10 s": (10.0, 2.0), "1: 20 s": (0.0, 20.0), "0": (10.0, 8.0)}  # the last: of a free window


def test_each_leg_of_the_plan_has_an_arrowhead_that_points_the_way():
    heads = [line for line in plan_view(INSTANCE, TOURS).lines if isinstance(line.get_marker(), tuple)]
    places = [line.get_xydata()[0].tolist() for line in heads]
    assert np.array(places) == pytest.approx(np.array([[4, 0.8], [6, 9.2], [0, 12]]))
    turns = [line.get_marker()[2] for line in heads]  # of a triangle that points up
    assert turns == pytest.approx([np.degrees(np.arctan2(2, 10)) - 90, np.degrees(np.arctan2(18, -10)) - 90, -180])


def test_a_leg_without_room_has_no_arrowhead():
    near = [Tour((Visit(0, 10.0, (10.0, 2.0)), Visit(1, 20.0, (10.1, 2.0))), 30.0)]
    assert sum(isinstance(line.get_marker(), tuple) for line in plan_view(INSTANCE, near).lines) == 2


def test_space_time_puts_visits_at_their_times():
    ax = space_time_view(INSTANCE, TOURS)
    assert _lines(ax, COLOURS[0])[0].tolist() == [[0, 0, 0], [10, 2, 10], [0, 20, 20], [0, 0, 30]]
    assert _lines(ax, "#F5C45E")[0].tolist() == [[10, 1, 5], [10, 3, 15]]
    assert [text.get_text() for text in ax.texts] == ["0", "1", " 0"]  # visits, then the window that has none


def test_a_window_across_a_bend_follows_the_path():
    bent = type(still(0, 0))([0, 10, 100], [[0, 0], [10, 0], [10, 30]], [(5, 40)])
    assert _lines(plan_view(instance(bent)), "#F5C45E")[0].tolist() == [[5, 0], [10, 0], [10, 10]]


@pytest.mark.parametrize("view", VIEWS)
def test_an_instance_without_tours_can_be_drawn(view):
    assert _legend(view(INSTANCE)) == ["target's path", "time window", "depot"]


def test_words_cover_neither_each_other_nor_a_tour():
    together = instance(still(10, 0), still(10, 0))
    tour = Tour((Visit(0, 10.0, (10.0, 0.0)), Visit(1, 11.0, (10.0, 0.0))), 30.0)
    ax = plan_view(together, [tour])
    ax.figure.draw_without_rendering()
    first, second = (text.get_window_extent() for text in ax.texts)
    assert not first.overlaps(second)
    leg = ax.transData.transform([(x, 0.0) for x in np.linspace(0.0, 10.0, 50)])
    assert not any(box.contains(*spot) for box in (first, second) for spot in leg)


def test_thirty_agents_are_told_apart():
    styles = {(COLOURS[k % len(COLOURS)], LINES[k % len(LINES)], MARKERS[k % len(MARKERS)]) for k in range(30)}
    assert len(styles) == 30


@pytest.mark.parametrize("view", VIEWS)
def test_a_saved_drawing_is_the_same_each_time(view, tmp_path):
    for name in ("one", "two"):
        save(view(INSTANCE, TOURS), tmp_path / name)
    for kind, start in (("pdf", b"%PDF"), ("png", b"\x89PNG")):
        first, second = ((tmp_path / f"{name}.{kind}").read_bytes() for name in ("one", "two"))
        assert first == second and first.startswith(start) and len(first) > 5000


@pytest.mark.parametrize(
    "suffix, start", [("pdf", b"%PDF"), ("png", b"\x89PNG"), ("svg", b"<?xml"), ("JPG", b"\xff\xd8")]
)
def test_a_drawing_is_saved_in_the_format_of_its_suffix_and_the_same_each_time(suffix, start, tmp_path):
    for name in ("one", "two"):
        save(plan_view(INSTANCE, TOURS), tmp_path / f"{name}.{suffix}")
    assert sorted(path.name for path in tmp_path.iterdir()) == [f"one.{suffix}", f"two.{suffix}"]
    first, second = ((tmp_path / f"{name}.{suffix}").read_bytes() for name in ("one", "two"))
    assert first == second and first.startswith(start)


@pytest.mark.parametrize(
    "name, message", [("plan.doc", "expected one of .pdf"), ("no/folder/plan.png", "cannot be written")]
)
def test_a_file_that_cannot_be_is_named(name, message, tmp_path):
    with pytest.raises(InputError, match=rf"{name}: {message}"):
        save(plan_view(INSTANCE), tmp_path / name)


def test_what_is_no_axes_is_not_saved(tmp_path):
    with pytest.raises(InputError, match="ax: expected Axes, found NoneType None"):
        save(None, tmp_path / "plan")


def test_what_is_no_path_is_not_saved_to():
    with pytest.raises(InputError, match="path: expected str or PathLike, found NoneType None"):
        save(plan_view(INSTANCE), None)


def test_the_charge_of_an_edge_is_free_until_big_m_lets_go():
    perspective, big_m, _ = charge_view(distance=40.0, size=100.0).lines
    assert np.column_stack(perspective.get_data()).tolist() == [[0, 0], [1, 40]]
    assert np.column_stack(big_m.get_data()).tolist() == [[0, 0], [0.6, 0], [1, 40]]


def test_shares_of_a_segment_are_the_segment_scaled():
    graph = build_graph(instance(moving((10, 0), (1, 0.2), [(20, 40)])))
    ax = perspective_view(graph, 1, shares=(0.5, 1.0))
    half, whole, nothing = (np.column_stack(line.get_data()) for line in ax.lines)
    assert [text.get_text() for text in ax.texts] == ["$y = 0.5$", "$y = 1$", "$y = 0$"]
    assert whole == pytest.approx(np.array([[30, 20], [50, 40]]))
    assert half == pytest.approx(whole / 2) and nothing.tolist() == [[0, 0]]


def test_sizes_are_drawn_against_the_number_of_agents():
    ax = sizes_view({"baseline": [10, 20, 30], "micp": [12, 12, 12]})
    assert [np.column_stack(line.get_data()).tolist()[-1] for line in ax.lines] == [[3, 30], [3, 12]]
    assert _legend(ax) == ["baseline", "MICP"]


def test_the_reach_of_an_agent_is_a_cone_in_time():
    road = instance(moving((10, 0), (0.5, 0), [(5, 15)]), still(-20, 0))
    ax = reach_view(road, 10.0, 20.0, meetings=[(30.0, 25.0)])
    assert ax.get_ylim()[0] < 0  # a star at time 0 would be whole
    assert ax.patches[0].get_xy()[:3].tolist() == [[10, 20], [10 - 4 * 80, 100], [10 + 4 * 80, 100]]
    assert _lines(ax, "#F5C45E")[0].tolist() == [[12.5, 5], [17.5, 15]]
    assert _legend(ax) == ["can be reached", "target's path", "time window", "earliest meeting", "agent"]
    assert [line.get_xydata().tolist() for line in ax.lines if line.get_label() == "earliest meeting"] == [[[30, 25]]]


def test_the_graph_has_a_circle_for_each_node_and_an_arrow_for_each_edge():
    graph = build_graph(instance(still(10, 0, [(0, 20), (30, 50)]), still(0, 10)))
    ax = graph_view(graph, route=[1, 3])
    arrows = [text.arrow_patch for text in ax.texts if getattr(text, "arrow_patch", None)]
    assert len(arrows) == len(graph.edges) and len(ax.lines) == len(graph.tau)
    assert sum(to_hex(arrow.get_edgecolor()).upper() == COLOURS[0] for arrow in arrows) == 3
    names = [text.get_text() for text in ax.texts if text.get_text()]
    assert names == ["s", "1", "2", "3", "s'", "target 0", "target 1"]


def test_a_descent_joins_its_start_and_its_stop():
    ax = descent_view([[30.0, 20.0], [15.0], [40.0, 25.0, 12.0]], optimum=11.0)
    start, stop, optimum = ax.lines
    assert list(start.get_ydata()) == [40, 15, 30] and list(stop.get_ydata()) == [12, 15, 20]
    assert set(optimum.get_ydata()) == {11.0}


@pytest.mark.parametrize("view", [*VIEWS, plot, lambda *given, unit: moment_view(*given, 15.0, unit=unit)])
def test_axes_name_the_unit_of_lengths(view):
    ax = view(INSTANCE, TOURS, unit="km")
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("x (km)", "y (km)")
