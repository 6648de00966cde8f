"""Drawings look as they did: pictures of fixed numbers beside the pictures in references/."""

import shutil
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest
from matplotlib.testing.compare import compare_images

from mamttsp import Tour, Visit, build_graph
from mamttsp.figures import (
    cactus_view,
    flow_view,
    growth_view,
    panels_view,
    perspective_view,
    plan_view,
    profile_view,
    reach_view,
    relaxation_view,
    relaxed_view,
    road_view,
    save,
    tilt_view,
    true_gap_view,
)
from tests.examples import instance, moving, still

REFERENCES = Path(__file__).with_name("references")
#: root mean square of the pixels' differences (0 to 255); fonts and lines that other versions draw a little elsewhere
TOLERANCE = 2.0


def _bars(value, highest=60.0):
    """Return rows of a figure with two panels, one run time missing, one below a bound, one gap in doubt."""
    times, gaps = ["<5", 20.0, 12.5, highest], [0.0, 0.0, "~3", 45.0]
    same = {"targets": [5, 5, 10, 10], "formulation": ["micp/scip", "baseline/scip"] * 2}
    first = pd.DataFrame(same | {"agents": value, "runtime_s": times, "gap_percent": gaps})
    missing = {"runtime_s": [1.0, 2.0, 30.0, np.nan], "gap_percent": [0.0, 0.0, 10.0, np.nan]}
    return pd.concat([first, first.assign(agents=value + 1, **missing)])


def _times():
    quick = np.geomspace(0.1, 40.0, 20)
    slow = np.where(quick > 4.0, np.inf, 10 * quick)
    return pd.DataFrame(
        {"micp/scip": 3 * quick[::-1], "baseline/scip": slow, "micp/clarabel": 1.5 * quick, "exact": quick}
    )


def _gaps():
    n, route = np.repeat([5, 10, 15], 8), ["micp/scip", "baseline/scip"] * 12
    above = np.where(np.arange(24) % 7 == 6, np.nan, np.arange(24) ** 3 / 500)
    return pd.DataFrame(
        {"n": n, "route": route, "incumbent_percent": above, "bound_percent": np.geomspace(1e-3, 99, 24)}
    )


FLIGHT = instance(
    moving((10, 0), (0, 0.4), [(5, 25), (60, 90)]), moving((-20, 10), (0.2, -0.2), [(0, 40)]), still(25, 25, [(20, 60)])
)
TOURS = [
    Tour((Visit(0, 10.0, (10.0, 4.0)), Visit(2, 30.0, (25.0, 25.0))), 50.0),
    Tour((Visit(1, 12.0, (-17.6, 7.6)),), 30.0),
]


def _relaxed():
    graph = build_graph(FLIGHT)
    route = [int(graph.C(u)[0]) for u in (0, 2, 1)]
    return relaxed_view(FLIGHT, graph, route, arrive=[10.0, 40.0, 30.0], leave=[20.0, 40.0, 35.0])


def _flow():
    ends = np.array([[0.0, 0.0], [10.0, 4.0], [25.0, 25.0], [-17.0, 7.0], [0.0, 0.0]])
    return flow_view(FLIGHT, np.array([1.0, 0.6, 0.4, 0.05]), ends[:-1], ends[1:])


def _tilted():
    t = np.linspace(0.0, 10.0, 30)
    return tilt_view(t, (t - 4.0) ** 2, 3.0 + 0.0 * t, best=12)


def _ratios():
    rows = [(n, w, m, (0.9 - 0.01 * n - 0.005 * w + 0.1 * k) * (m == "micp")) for n in (5, 10) for w in (20, 40, 60)
            for m in ("micp", "baseline") for k in (0, 1)]  # fmt: skip
    return relaxation_view(pd.DataFrame(rows, columns=["n", "total_window", "method", "ratio"]))


DRAWINGS = {
    "plan": lambda: plan_view(FLIGHT, TOURS),
    "relaxed-times": _relaxed,
    "flow": _flow,
    "road": lambda: road_view([f"part {k}" for k in range(1, 6)]),
    "tilt": _tilted,
    "reach": lambda: reach_view(instance(moving((10, 0), (0.5, 0), [(5, 15)])), 0.0, 0.0, [(12.5, 5.0)]),
    "perspective": lambda: perspective_view(build_graph(FLIGHT), 1),
    "growth": lambda: growth_view(
        [10, 20], [9.0, 8.0], {"micp": [8.0, 7.0], "micp without (22)": [6.0, 5.0], "baseline": [0.0, 0.0]}
    ),
    "ratios": _ratios,
    "panels": lambda: panels_view(_bars(2), "agents", "Ours", "Solver 1.0, limit 60 s, a laptop")[0],
    "cactus": lambda: cactus_view(_times(), 60.0),
    "profile": lambda: profile_view(_times()),
    "true-gaps": lambda: true_gap_view(_gaps(), "incumbent_percent"),
    "true-bounds": lambda: true_gap_view(_gaps(), "bound_percent"),
}


@pytest.fixture(autouse=True)
def close_figures():
    yield
    plt.close("all")


def _difference(ax, name, folder):
    """Return what compare_images says: nothing if the picture is the reference within the tolerance."""
    expected = shutil.copy(REFERENCES / f"{name}.png", folder / "expected.png")
    save(ax, folder / "actual")
    return compare_images(expected, str(folder / "actual.png"), TOLERANCE)


@pytest.mark.parametrize("name", DRAWINGS)
def test_a_drawing_looks_like_its_reference(name, tmp_path):
    difference = _difference(DRAWINGS[name](), name, tmp_path)
    assert difference is None, f"{difference}\nLook at it, and copy it to {REFERENCES / name}.png if it is wanted."


def test_another_height_of_one_bar_is_another_picture(tmp_path):
    changed = panels_view(_bars(2, highest=20.0), "agents", "Ours", "Solver 1.0, limit 60 s, a laptop")[0]
    assert _difference(changed, "panels", tmp_path)
