"""Tracks made up here: thinned within the tolerance, in windows that are inside the area, on a map in km."""

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mamttsp import Agents, InputError, Instance, check, solve
from mamttsp.tracks import project, thin, tracks_to_targets, windows_inside

SQUARE = np.array([(-10.0, -10.0), (10.0, -10.0), (10.0, 10.0), (-10.0, 10.0)])
#: a U, so that a straight way leaves it and comes back
U = np.array([(-10, -10), (10, -10), (10, 10), (5, 10), (5, -5), (-5, -5), (-5, 10), (-10, 10)], dtype=float)


def wandering(seed, K=60):
    """Return times (K,) at uneven intervals and points (K, 2) of a track that turns slowly."""
    rng = np.random.default_rng(seed)
    times = np.cumsum(rng.uniform(5, 15, K))
    headings = np.cumsum(rng.normal(0, 0.3, K))
    steps = 0.05 * np.diff(times, prepend=times[0])[:, None] * np.c_[np.cos(headings), np.sin(headings)]
    return times, np.cumsum(steps, axis=0)


@given(st.integers(0, 1000), st.floats(0.01, 5))
def test_no_report_is_farther_off_than_the_tolerance(seed, tolerance):
    times, points = wandering(seed)
    kept = thin(times, points, tolerance)
    straight = np.stack([np.interp(times, times[kept], points[kept, axis]) for axis in (0, 1)], axis=1)
    assert np.hypot(*(points - straight).T).max() <= tolerance * (1 + 1e-9)
    assert kept[0] == 0 and kept[-1] == len(times) - 1


def test_a_straight_track_at_one_speed_is_one_piece_and_a_stop_is_not_lost():
    times = np.arange(5.0)
    assert thin(times, np.c_[times, 2 * times], 1e-6) == [0, 4]
    stops = np.c_[[0.0, 1.0, 1.0, 1.0, 2.0], np.zeros(5)]
    assert thin(times, stops, 0.1) == [0, 1, 3, 4]


@pytest.mark.parametrize("area", [SQUARE, U])
@given(seed=st.integers(0, 1000))
def test_windows_are_when_the_track_is_inside(area, seed):
    from matplotlib.path import Path

    times, points = wandering(seed)
    windows = windows_inside(times, points, area)
    moments = np.linspace(times[0], times[-1], 500)
    places = np.stack([np.interp(moments, times, points[:, axis]) for axis in (0, 1)], axis=1)
    inside = Path(area).contains_points(places)
    in_window = np.array([any(a <= t <= b for a, b in windows) for t in moments])
    near_edge = np.array([any(abs(t - edge) < 1e-6 for window in windows for edge in window) for t in moments])
    assert (inside == in_window)[~near_edge].all()
    assert all(b < c for (_, b), (c, _) in zip(windows, windows[1:]))


def test_in_and_out_of_a_u():
    assert windows_inside(np.array([0.0, 40.0]), np.array([(-20.0, 0.0), (20.0, 0.0)]), U) == [
        (10.0, 15.0),
        (25.0, 30.0),
    ]


def test_a_degree_of_latitude_is_111_km_and_of_longitude_less():
    x, y = project([(5.0, 52.0), (4.0, 53.0)], (4.0, 52.0)).T
    assert x == pytest.approx([111.195 * np.cos(np.radians(52)), 0.0], rel=1e-4) and y == pytest.approx(
        [0.0, 111.195], rel=1e-4
    )


def _ships():
    lon, lat = np.linspace(3.9, 4.3, 9), np.linspace(51.95, 52.05, 9)
    ferry = pd.DataFrame({"track": "ferry", "time": np.arange(9) * 600.0, "lon": lon, "lat": 52.0})
    pilot = pd.DataFrame({"track": "pilot", "time": np.arange(9) * 600.0, "lon": 4.1, "lat": lat})
    away = pd.DataFrame({"track": "away", "time": [0.0, 4800.0], "lon": [7.0, 7.1], "lat": [54.0, 54.0]})
    return pd.concat([ferry, pilot, away], ignore_index=True).sample(frac=1.0, random_state=1)


PORT = [(4.0, 51.98), (4.2, 51.98), (4.2, 52.02), (4.0, 52.02)]


def test_ships_become_targets_in_km_and_can_be_visited():
    targets = tracks_to_targets(_ships(), PORT, tolerance=0.05)
    assert set(targets) == {"ferry", "pilot"}
    ferry = targets["ferry"]
    assert len(ferry.times) == 2 and ferry.windows == pytest.approx(np.array([[1200.0, 3600.0]]), rel=1e-6)
    assert ferry.speeds == pytest.approx([0.4 * 111.195 * np.cos(np.radians(52)) / 4800.0], rel=1e-3)
    instance = Instance(targets.values(), agents=[Agents(1, (0.0, 0.0), 0.02)], horizon=4800.0)
    solution = solve(instance)
    assert solution.status == "optimal" and check(instance, solution) == pytest.approx(solution.objective)


def test_dates_are_seconds_since_the_first_one():
    dated = _ships()
    dated["time"] = pd.Timestamp("2024-05-01 12:00") + pd.to_timedelta(dated["time"], unit="s")
    plain, found = tracks_to_targets(_ships(), PORT, 0.05), tracks_to_targets(dated, PORT, 0.05)
    for name in plain:
        assert found[name].times == pytest.approx(plain[name].times)
        assert found[name].windows == pytest.approx(plain[name].windows)


LINE = pd.DataFrame({"track": "a", "time": [0.0, 10.0], "x": [0.0, 10.0], "y": [0.0, 0.0]})


@pytest.mark.parametrize(
    "frame, area, tolerance, message",
    [
        (LINE.drop(columns="y"), SQUARE, 1.0, "frame: expected a DataFrame with the columns track, time and x, y"),
        (LINE.drop(columns="track"), SQUARE, 1.0, "frame: expected"),
        ("no frame", SQUARE, 1.0, "frame: expected"),
        (LINE, SQUARE[:2], 1.0, "area: expected at least 3 corners"),
        (LINE, "square", 1.0, "area: expected numbers"),
        (LINE, SQUARE + 100, 1.0, "area: no track is ever inside it"),
        (LINE, SQUARE, 0.0, "tolerance: expected a finite number above 0"),
        (LINE[:1], SQUARE, 1.0, "track 'a': expected at least 2 positions, found 1"),
        (LINE.assign(time=5.0), SQUARE, 1.0, "track 'a': two positions at the time 5"),
        (LINE.assign(x=[0.0, np.nan]), SQUARE, 1.0, "track 'a': every position must be finite"),
    ],
)
def test_bad_tracks_are_one_line(frame, area, tolerance, message):
    with pytest.raises(InputError, match=f"^{message}") as caught:
        tracks_to_targets(frame, area, tolerance)
    assert len(str(caught.value).splitlines()) == 1
