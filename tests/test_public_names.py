"""Whatever the reference of the site names: a first argument of a wrong type is an InputError of one line."""

import importlib
import inspect
import re
from pathlib import Path

import matplotlib.pyplot as plt
import pytest

import mamttsp
from mamttsp import InputError, Progress, Tour, Visit
from mamttsp.figures import film

API = Path(__file__).parents[1] / "docs" / "api"
WRONG = {"a number": 3.5, "nothing": None, "a list of one thing": [object()], "a dict": {"a": 1}, "an object": object()}
#: what the package makes and hands out; tours and solutions of a user's own are looked at where they are handed over
MADE_BY_THE_PACKAGE = {"Film", "Graph", "PaperSolution", "Progress", "Solution", "Tour", "Visit"}
#: good arguments of a call, for those behind the first one
GOOD = {
    "agent": "agent.toml",
    "area": [(0, 0), (1, 0), (1, 1)],
    "depot": (0, 0),
    "horizon": 100,
    "index": 0,
    "max_speed": 4,
    "n_agents": 1,
    "path": "rows.csv",
    "place": 0.0,
    "points": [(0, 0), (1, 0)],
    "solution": [],
    "t": 0.0,
    "time": 0.0,
    "tolerance": 1.0,
    "total_window": 20,
    "tours": [],
    "v": [(0, 0)],
    "where": "agents[0]",
    "windows": [(0, 1)],
}


def documented():
    """Return {name: (module, name in it)} of the functions and classes in the reference."""
    found, home = {}, None
    for page in sorted(API.glob("*.md")):
        for kind, name in re.findall(r"^\.\. (\w+):: (\S+)$", page.read_text(encoding="utf-8"), re.MULTILINE):
            if kind in ("currentmodule", "automodule"):
                home = name
            elif kind in ("autofunction", "autoclass"):
                module, _, own = name.rpartition(".")
                found[own] = getattr(importlib.import_module(module or home), own)
    return found


def callables():
    """Return {name: callable} of all that has an argument: functions, classes of users and methods of all classes."""
    problem = mamttsp.generate(3, 20, seed=1)
    visit = Visit(0, 1.0, (0.0, 0.0))
    solution = mamttsp.Solution("feasible", 1.0, None, 0.0, (), "", "")
    examples = [problem, problem.targets[0], problem.agents[0], mamttsp.build_graph(problem), solution, visit]
    examples += [Tour((visit,), 2.0), Progress(0.0, None, None, None, None, ""), film(problem, [], step=100)]
    objects = {type(example).__name__: example for example in examples}
    found = {}
    for name, own in documented().items():
        if name not in MADE_BY_THE_PACKAGE:
            found[name] = own
        if inspect.isclass(own) and name in objects:
            methods = [method for method in vars(own) if not method.startswith("_")]
            bound = {f"{name}.{method}": getattr(objects[name], method) for method in methods}
            found |= {method: call for method, call in bound.items() if inspect.ismethod(call)}
    return {name: call for name, call in found.items() if inspect.signature(call).parameters}


CALLS = callables()


def test_everything_is_found():
    assert len(CALLS) > 40 and {"solve", "Instance.read", "Film.save", "explore", "campaign"} <= set(CALLS)


@pytest.fixture(autouse=True)
def close_figures():
    yield
    plt.close("all")


PAIRS = {(name, wrong) for name in CALLS for wrong in WRONG} - {("Target.position", "a number")}  # it wants one


@pytest.mark.parametrize("name, wrong", sorted(PAIRS))
def test_a_wrong_first_argument_is_told_in_one_line(name, wrong):
    first, *others = inspect.signature(CALLS[name]).parameters.values()
    needed = {other.name: GOOD[other.name] for other in others if other.default is other.empty and other.name in GOOD}
    figures = plt.get_fignums()
    with pytest.raises(InputError) as caught:
        CALLS[name](WRONG[wrong], **needed)
    assert str(caught.value) and "\n" not in str(caught.value) and len(str(caught.value)) < 200
    assert plt.get_fignums() == figures  # no empty drawing is left behind


DRAWINGS = [name for name, call in CALLS.items() if "ax" in list(inspect.signature(call).parameters)[1:]]


@pytest.mark.parametrize("name", DRAWINGS)
def test_a_drawing_wants_axes(name):
    problem = mamttsp.generate(3, 20, seed=1)
    firsts = {"graph_view": mamttsp.build_graph(problem), "trace_view": []}
    needed = {"tours": [], "time": 0.0, "place": 0.0}
    asked = inspect.signature(CALLS[name]).parameters
    for wrong in (0, [], "ax", plt.figure()):
        with pytest.raises(InputError, match=r"^ax: expected Axes, found [^\n]*\Z"):
            own = {key: value for key, value in needed.items() if key in asked and asked[key].default is inspect._empty}
            CALLS[name](firsts.get(name, problem), **own, ax=wrong)


def test_space_and_time_want_axes_of_three_dimensions():
    with pytest.raises(InputError, match='^ax: expected axes with projection="3d", found flat ones$'):
        mamttsp.figures.space_time_view(mamttsp.generate(3, 20, seed=1), ax=plt.figure().add_subplot())


@pytest.mark.parametrize(
    "message, call",
    {
        "route: expected a whole number": lambda graph: mamttsp.figures.graph_view(graph, ["x"]),
        "route: expected a list": lambda graph: mamttsp.figures.graph_view(graph, 3),
        "against: expected one of time, report, found 'x'": lambda _: mamttsp.figures.trace_view([], "x"),
        "time: expected numbers in the shape 4": lambda _: mamttsp.figures.explore(print, time="abcd"),
        "dpi: expected a finite number above 0": lambda graph: mamttsp.figures.save(
            mamttsp.figures.graph_view(graph), "plan.png", "x"
        ),
        "kind: expected instance or solution, found 'tour'": lambda _: mamttsp.schemas.schema("tour"),
        "folder: expected str or PathLike": lambda _: mamttsp.load("n20-i03-w40", folder=3),
        "agents: expected a list of Agents, found 3": lambda _: mamttsp.generate(3, 20, agents=3),
        "agents[0]: expected Agents, found dict": lambda _: mamttsp.generate(3, 20, agents=[{}]),
        "agents: expected at least one entry": lambda _: mamttsp.generate(3, 20, agents=[]),
    }.items(),
)
def test_other_arguments_are_told_as_well(message, call):
    with pytest.raises(InputError) as caught:
        call(mamttsp.build_graph(mamttsp.generate(3, 20, seed=1)))
    assert str(caught.value).startswith(message) and "\n" not in str(caught.value)
