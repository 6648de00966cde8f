"""Own data: arrays, data frames and parked targets make the instance that was meant, or one line says what is wrong."""

import numpy as np
import pandas as pd
import pytest

from mamttsp import Agents, InputError, Instance, Target

FLEET = {"n_agents": 2, "depot": (0.0, 0.0), "max_speed": 4.0}
P, V, WINDOWS = [[30, 0], [-20, 10], [5, 5]], [[0, 0.5], [0.2, 0], [0, 0]], [(10, 30), (40, 60), (0, 100)]


def frames():
    rows = [["b", 50, 30, 25], ["a", 0, 1, 2], ["b", 0, 30, 0], ["b", 100, 0, 25]]
    windows = [["a", 60, 70], ["a", 5, 8], ["b", 10, 90]]
    return pd.DataFrame(rows, columns=["target", "time", "x", "y"]), pd.DataFrame(
        windows, columns=["target", "start", "end"]
    )


def test_arrays_are_straight_motions_over_the_horizon():
    made = Instance.from_arrays(P, V, WINDOWS, 100, **FLEET)
    for target, p, v, window in zip(made.targets, P, V, WINDOWS, strict=True):
        assert target.times.tolist() == [0, 100] and target.windows.tolist() == [list(window)]
        assert target.position(40) == pytest.approx(np.add(p, 40 * np.array(v)))
    assert (made.n_agents, made.max_speed, made.horizon, made.depot.tolist()) == (2, 4, 100, [0, 0])


@pytest.mark.parametrize("as_given", [np.array, list])
def test_several_windows_each_and_unequal_numbers_of_them(as_given):
    two = [[(10, 30), (50, 60)], [(0, 1), (2, 3)], [(0, 10), (90, 100)]]
    made = Instance.from_arrays(np.array(P), np.array(V), as_given(two), 100, **FLEET)
    assert [target.windows.tolist() for target in made.targets] == [[list(w) for w in windows] for windows in two]
    made = Instance.from_arrays(P, V, [*two[:2], [(0, 10)]], 100, **FLEET)
    assert [len(target.windows) for target in made.targets] == [2, 2, 1]


def test_frames_may_be_in_any_order_and_name_targets_as_they_like():
    made = Instance.from_frames(*frames(), 100, **FLEET)
    b, a = made.targets
    assert b.times.tolist() == [0, 50, 100] and b.points.tolist() == [[30, 0], [30, 25], [0, 25]]
    assert a.windows.tolist() == [[5, 8], [60, 70]] and a.position(65).tolist() == [1, 2]


def test_a_parked_target_needs_a_point_and_its_windows():
    target = Target.parked((3, 4), [(2, 8), (10, 12)])
    assert target.speeds.tolist() == [0] and target.windows.tolist() == [[2, 8], [10, 12]]
    assert target.position(np.array([0.0, 5.0, 11.0])).tolist() == [[3, 4]] * 3
    assert Target.parked((3, 4), (0, 0)).windows.tolist() == [[0, 0]]


@pytest.mark.parametrize("make", [lambda: Instance.from_arrays(P, V, WINDOWS, 100, **FLEET),
                                  lambda: Instance.from_frames(*frames(), 100, **FLEET),
                                  lambda: Instance([Target.parked((3, 4), (2, 8))], horizon=10, **FLEET)])  # fmt: skip
def test_own_data_survives_its_file(make, tmp_path):
    make().write(tmp_path / "instance.json")
    assert Instance.read(tmp_path / "instance.json") == make()


@pytest.mark.parametrize(
    "change, message",
    [
        ({"p": 3}, "p: expected the shape Kx2, found a number"),
        ({"v": V[:2]}, "v: expected one for each of the 3 rows of p, found 2"),
        ({"windows": WINDOWS[:2]}, "windows: expected one for each of the 3 rows of p, found 2"),
        ({"windows": 3}, "windows: expected one for each of the 3 rows of p, found 3"),
        ({"windows": [(10, 30), 5, (0, 100)]}, "targets[1].windows: expected"),
        ({"windows": [(10, 30), [], (0, 100)]}, "targets[1].windows: expected the shape"),
        ({"windows": [(10, 30), (60, 40), (0, 100)]}, "targets[1].windows[0]: ends at 40 before it starts"),
        ({"horizon": "long"}, "horizon: expected a finite number above 0, found 'long'"),
        ({"v": [[9, 9]] * 3}, "targets[0].points: speed 12.7279 is not below max_speed"),
    ],
)
def test_arrays_that_do_not_fit_are_named(change, message):
    with pytest.raises(InputError) as caught:
        Instance.from_arrays(**{"p": P, "v": V, "windows": WINDOWS, "horizon": 100} | FLEET | change)
    assert str(caught.value).startswith(message) and "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "change, message",
    [
        (
            lambda b, w: ({}, w),
            "breakpoints: expected a DataFrame with the columns target, time, x, y; missing: target",
        ),
        (
            lambda b, w: (b.drop(columns="y"), w),
            "breakpoints: expected a DataFrame with the columns target, time, x, y; missing: y",
        ),
        (
            lambda b, w: (b, w.rename(columns={"end": "stop"})),
            "windows: expected a DataFrame with the columns target, start, end",
        ),
        (lambda b, w: (b, w[w.target == "a"]), "windows: target 'b' has none"),
        (lambda b, w: (b[b.target == "a"], w), "windows: target 'b' has no breakpoints"),
        (lambda b, w: (b.assign(x=[1.0, 1.0, np.nan, 1.0]), w), "target 'b'.points: every value must be finite"),
        (lambda b, w: (b.assign(time=[0, 0, 0, 100]), w), "target 'b'.times[1]: 0 does not come after 0"),
    ],
)
def test_frames_that_do_not_fit_are_named(change, message):
    with pytest.raises(InputError) as caught:
        Instance.from_frames(*change(*frames()), 100, **FLEET)
    assert str(caught.value).startswith(message) and "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "point, windows, message",
    [
        (3, (2, 8), "point: expected the shape 2, found a number"),
        ((3, "y"), (2, 8), "point: expected numbers"),
        ((3, 4), 5, "windows: expected"),
        ((3, 4), [], "windows: expected the shape"),
        ((3, 4), (8, 2), r"windows[0]: ends at 2 before it starts at 8"),
        ((3, 4), (-5, 2), r"windows[0]: (-5, 2) is not covered"),
    ],
)
def test_a_parked_target_that_cannot_be_is_named(point, windows, message):
    with pytest.raises(InputError) as caught:
        Target.parked(point, windows)
    assert str(caught.value).startswith(message)


def test_own_data_may_have_unlike_agents():
    agents = [Agents(2, (0, 0), 4.0), Agents(1, (9, 0), 6.0, end=(0, 0), capacity=5.0)]
    for made in (
        Instance.from_arrays(P, V, WINDOWS, 100, agents=agents),
        Instance.from_frames(*frames(), 100, agents=agents),
    ):
        assert list(made.agents) == agents and made.n_agents == 3
