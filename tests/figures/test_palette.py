"""A method looks the same in every drawing, and only style.py says how."""

import ast
import re
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest
from matplotlib.colors import to_rgb

import mamttsp
from mamttsp.figures import (
    cactus_view,
    charge_view,
    descent_view,
    growth_view,
    leak_view,
    profile_view,
    relaxation_view,
    runtime_gap_view,
    sizes_view,
    true_gap_view,
)
from mamttsp.figures.style import bar_style, in_order, method_style, route_name, shades

FOLDER = Path(mamttsp.__file__).parent
#: all that draws: the figures, and what the experiments make of them
MODULES = sorted([*(FOLDER / "figures").glob("*.py"), *(FOLDER / "experiments").glob("*.py")])
METHODS = ("micp", "baseline", "nonconvex", "exact")
#: words by which a drawing could mean a method
SPOKEN = re.compile(r"\b(micp|baseline|nonconvex|exact|perspective|big-m|clarabel|scip)\b", re.IGNORECASE)
COLOUR = re.compile(r"#[0-9a-fA-F]{6}|C\d|(tab|xkcd):.*|blue|orange|red|green|purple|pink|brown|cyan|magenta")


@pytest.fixture(autouse=True)
def close_figures():
    yield
    plt.close("all")


def _names_a_colour(node):
    """Tell whether a part of a syntax tree is a colour that is not grey, or picks one of the agents' colours."""
    return (isinstance(node, ast.Constant) and isinstance(node.value, str) and bool(COLOUR.fullmatch(node.value))) or (
        isinstance(node, ast.Name) and node.id in ("COLOURS", "MARKERS")
    )


def _own_colours(source):
    """Return the lines of functions that speak of a method and of a colour of their own."""
    found = []
    for function in ast.walk(ast.parse(source)):
        if isinstance(function, ast.FunctionDef):
            code = [
                n for statement in function.body[ast.get_docstring(function) is not None :] for n in ast.walk(statement)
            ]
            texts = [n.value for n in code if isinstance(n, ast.Constant) and isinstance(n.value, str)]
            called = {n.func.id for n in code if isinstance(n, ast.Call) and isinstance(n.func, ast.Name)}
            if any(SPOKEN.search(text) for text in texts) or called & {"method_style", "bar_style", "shades"}:
                found += [node.lineno for node in code if _names_a_colour(node)]
    return found


@pytest.mark.parametrize("path", MODULES, ids=lambda path: path.stem)
def test_no_drawing_names_a_colour_for_a_method(path):
    source = path.read_text(encoding="utf-8")
    if path.stem != "style":
        assert not re.search(r"[\"']#[0-9a-fA-F]{6}", source)
        assert not _own_colours(source)


@pytest.mark.parametrize(
    "line", ['ax.plot(x, color=COLOURS[1], label="baseline")', 'ax.bar(x, y, color="#D55E00", label="the MICP")']
)
def test_the_test_sees_such_a_colour(line):
    assert _own_colours(f"def view(ax):\n    {line}\n") == [2]


RATIOS = pd.DataFrame(
    [(n, w, 1, m, 0.9) for n in (5, 10) for w in (20, 40) for m in ("micp", "baseline")],
    columns=["n", "total_window", "agents", "method", "ratio"],
)
TIMES = pd.DataFrame({"micp/scip": [1.0, 4.0], "baseline/scip": [2.0, 2.0], "micp/clarabel": [1.0, 1.0], "exact": 0.5})
BARS = pd.DataFrame(
    {"targets": [5, 5], "formulation": ["micp", "baseline"], "runtime_s": [1.0, 2.0], "gap_percent": [0.0, 1.0]}
)
GAPS = pd.DataFrame({"n": [5, 5], "route": ["micp/scip", "baseline/scip"], "incumbent_percent": [1.0, 2.0]})
DRAWINGS = {
    "growth": lambda: growth_view([10, 20], [9.0, 8.0], {"micp": [8.0, 7.0], "baseline": [0.0, 0.0]}),
    "leak": lambda: leak_view([0.1, 1.0], {method: [9.0, 9.0] for method in METHODS}, [9.0, 9.0], 0.5),
    "sizes": lambda: sizes_view({method: [1, 2] for method in METHODS}),
    "relaxations": lambda: relaxation_view(RATIOS),
    "cactus": lambda: cactus_view(TIMES, 60.0),
    "profile": lambda: profile_view(TIMES),
    "gaps": lambda: true_gap_view(GAPS, "incumbent_percent"),
    "charge": lambda: charge_view(40.0, 100.0),
}
SAID = {"perspective: y d": "micp", "big-M: max(0, d - R (1 - y))": "baseline", "MICP, Clarabel": "micp/clarabel"}


@pytest.mark.parametrize("name", DRAWINGS)
def test_a_method_has_its_colour_and_marker_in_every_drawing(name):
    seen = []
    for line in DRAWINGS[name]().lines:
        method = SAID.get(line.get_label()) or next((m for m in METHODS if m in line.get_label().lower()), None)
        if method and not line.get_label().startswith("_"):
            style = method_style(method)
            if "windows" not in line.get_label():  # of settings: a shade of the method's colour
                assert line.get_color() == style["color"]
            assert line.get_marker() == ("" if name == "charge" else style["marker"])
            seen.append(method)
    assert len(seen) > 1


def test_bars_and_lines_of_one_method_have_one_colour():
    ax = runtime_gap_view(BARS)
    assert [bar.get_edgecolor()[:3] for bar in ax.patches] == [
        to_rgb(method_style(m)["color"]) for m in BARS.formulation
    ]


def test_the_local_method_has_the_colour_of_its_program():
    start, stop, _ = descent_view([[3.0, 2.0]], 2.0).lines
    assert start.get_color() == stop.get_color() == method_style("nonconvex")["color"]


def test_no_two_methods_look_alike():
    styles = [method_style(route) for route in (*METHODS, "micp/clarabel")]
    for name in ("color", "marker", "linestyle"):
        assert len({style[name] for style in styles}) == len(styles)
    assert len({bar_style(route)["hatch"] for route in ("micp/scip", "baseline/scip", "micp/clarabel", "exact")}) == 4


def test_a_route_is_drawn_as_its_method_and_a_variant_as_a_hollow_one():
    assert method_style("baseline/gurobi") == method_style("baseline")
    plain, variant = method_style("micp"), method_style("micp without (22)")
    assert variant["color"] == plain["color"] and variant["linestyle"] == ":" and variant["markerfacecolor"] == "white"
    assert route_name("micp without (22)") == "MICP without (22)" and route_name("micp/scip") == "MICP, SCIP"


def test_routes_have_one_order_and_shades_end_at_the_methods_own_colour():
    assert in_order(["exact", "baseline/scip", "micp/scip", "exact"]) == ["micp/scip", "baseline/scip", "exact"]
    light, middle, own = np.array(shades("micp", 3))
    assert (
        own == pytest.approx(to_rgb(method_style("micp")["color"])) and (light > middle).all() and (middle > own).all()
    )
    assert shades("micp", 1) == [tuple(own)]
