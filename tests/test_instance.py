"""Target and Instance: what they hold, their file, every kind of bad input, in the library and on the command line."""

import dataclasses
import json
import math
import subprocess
import sys

import numpy as np
import pytest

from mamttsp import Agents, InputError, Instance, Target, build_graph, generate
from mamttsp.__main__ import main
from tests.examples import agents, general, instance, moving, still

GOOD = instance(moving((1, 2), (0.5, 0), [(10, 30), (60, 80)]), still(5, 5), n_agents=2)


def test_a_target_is_where_its_path_says():
    target = Target([0, 10, 20], [[0, 0], [10, 0], [10, 5]], [(0, 20)])
    assert target.position(5) == pytest.approx([5, 0])
    assert target.position([10, 15]) == pytest.approx(np.array([[10, 0], [10, 2.5]]))
    assert target.speeds == pytest.approx([1, 0.5])


def test_an_instance_cannot_be_changed():
    with pytest.raises(AttributeError):
        GOOD.n_agents = 3
    with pytest.raises(ValueError, match="read-only"):
        GOOD.targets[0].points[0, 0] = 1.0


def test_the_size_is_the_diagonal_of_all_that_happens():
    assert instance(moving((0, 0), (0.3, 0.4))).size == pytest.approx(50.0)
    assert instance(still(3, 4)).size == pytest.approx(5.0)


def test_another_number_of_agents_changes_nothing_else():
    more = GOOD.with_agents(5)
    assert more.n_agents == 5 and more.with_agents(2) == GOOD != more


def test_an_instance_survives_its_file(tmp_path):
    for written in (GOOD, generate(6, 40, n_agents=3, seed=5)):
        written.write(tmp_path / "instance.json")
        read = Instance.read(tmp_path / "instance.json")
        assert read == written and hash(read) == hash(written)


def test_an_instance_may_carry_the_big_m_of_its_area(tmp_path):
    wider = dataclasses.replace(GOOD, R=250)
    wider.write(tmp_path / "instance.json")
    assert json.loads((tmp_path / "instance.json").read_text())["R"] == 250.0
    read = Instance.read(tmp_path / "instance.json")
    assert read == wider != GOOD and read.with_agents(5).R == 250.0
    assert read.size == GOOD.size and "R" not in GOOD.to_dict()


def test_the_big_m_of_a_graph_is_the_instance_s_own_or_its_size():
    assert GOOD.size == build_graph(GOOD).R
    assert build_graph(dataclasses.replace(GOOD, R=250)).R == 250.0


def test_a_big_m_that_forbids_flights_is_refused():
    """Between (3, 4) and (-3, -4) it is 10 units, 5 from the depot."""
    apart = instance(still(3, 4), still(-3, -4))
    assert dataclasses.replace(apart, R=10.0).R == 10.0
    with pytest.raises(InputError, match="^R: 9.9 is less than 10, "):
        dataclasses.replace(apart, R=9.9)
    for wrong in (0, -1.0, math.inf, "wide", True):
        with pytest.raises(InputError, match="^R: expected a finite number above 0"):
            dataclasses.replace(apart, R=wrong)


def test_the_file_has_the_fields_of_the_format():
    assert json.loads(json.dumps(instance(still(1, 2, [(10, 30)])).to_dict())) == {
        "format": "mamttsp-instance",
        "version": 1,
        "depot": [0.0, 0.0],
        "max_speed": 4.0,
        "horizon": 100.0,
        "n_agents": 1,
        "targets": [{"times": [0.0, 100.0], "points": [[1.0, 2.0], [1.0, 2.0]], "windows": [[10.0, 30.0]]}],
    }


def test_a_failed_write_leaves_the_old_file_and_nothing_else(tmp_path):
    path = tmp_path / "instance.json"
    GOOD.write(path)
    before = path.read_text()
    with pytest.raises(InputError, match="cannot be written"):
        GOOD.write(path / "below-a-file.json")
    assert path.read_text() == before and list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("windows", [[(10, 20), (20, 30)], [(10, 10)], [(0, 100)]])
def test_windows_may_touch_be_one_moment_and_fill_the_horizon(windows):
    assert still(1, 1, windows).windows.tolist() == [list(map(float, window)) for window in windows]


UNLIKE = general(
    moving((1, 2), (0.5, 0), [(10, 30)], demand=2.0),
    still(5, 5),
    types=[agents(2), agents(1, (40.0, 0.0), max_speed=6.0, end=(0.0, 0.0), capacity=5.0)],
)

# --- Types of agents, and demands ------------------------------------------------------------------------------------


def test_the_file_of_version_2_has_the_fields_of_the_format():
    assert json.loads(json.dumps(UNLIKE.to_dict())) == {
        "format": "mamttsp-instance",
        "version": 2,
        "horizon": 100.0,
        "agents": [
            {"count": 2, "depot": [0.0, 0.0], "max_speed": 4.0},
            {"count": 1, "depot": [40.0, 0.0], "max_speed": 6.0, "end": [0.0, 0.0], "capacity": 5.0},
        ],
        "targets": [
            {"times": [0.0, 100.0], "points": [[1.0, 2.0], [51.0, 2.0]], "windows": [[10.0, 30.0]], "demand": 2.0},
            {"times": [0.0, 100.0], "points": [[5.0, 5.0], [5.0, 5.0]], "windows": [[0.0, 100.0]]},
        ],
    }


def test_an_instance_of_version_2_survives_its_file(tmp_path):
    UNLIKE.write(tmp_path / "instance.json")
    read = Instance.read(tmp_path / "instance.json")
    assert read == UNLIKE and hash(read) == hash(UNLIKE) and read.agents == UNLIKE.agents


def test_version_2_that_says_nothing_new_is_version_1():
    data = GOOD.to_dict()
    entry = {"count": data["n_agents"], "depot": data["depot"], "max_speed": data["max_speed"]}
    same = {"format": "mamttsp-instance", "version": 2, "horizon": data["horizon"], "targets": data["targets"]}
    for agents_field in ([entry], [entry | {"end": data["depot"], "capacity": None}], [entry | {"end": None}]):
        read = Instance.from_dict(same | {"agents": agents_field})
        assert read == GOOD and read.plain and read.to_dict() == data


@pytest.mark.parametrize(
    "changed",
    [
        general(still(1, 1), types=[agents(end=(1.0, 0.0))]),
        general(still(1, 1), types=[agents(capacity=3.0)]),
        general(still(1, 1), types=[agents(), agents()]),
        general(still(1, 1, demand=0.5), types=[agents()]),
    ],
)
def test_what_version_1_cannot_say_is_version_2(changed, tmp_path):
    assert not changed.plain and changed.to_dict()["version"] == 2
    changed.write(tmp_path / "instance.json")
    assert Instance.read(tmp_path / "instance.json") == changed


def test_what_the_types_have_in_common():
    assert (UNLIKE.n_agents, UNLIKE.counts) == (3, (2, 1))
    assert general(still(1, 1), types=[agents(), agents(max_speed=5.0)]).depot.tolist() == [0.0, 0.0]
    for field in ("depot", "max_speed"):
        with pytest.raises(InputError, match=f"^{field}: the types of agents differ"):
            getattr(UNLIKE, field)
    assert general(still(3, 4), types=[agents(end=(0.0, -4.0))]).size == pytest.approx(math.hypot(3, 8))


def test_another_number_of_agents_of_the_only_type():
    one = general(still(1, 1), types=[agents(2, end=(5.0, 0.0), capacity=3.0)])
    assert one.with_agents(4).agents == (agents(4, end=(5.0, 0.0), capacity=3.0),)
    with pytest.raises(InputError, match="^n_agents: there are 2 types of agents"):
        UNLIKE.with_agents(2)


def test_an_end_is_the_depot_unless_it_is_said():
    assert agents(depot=(1.0, 2.0)).end.tolist() == [1.0, 2.0] and agents().capacity is None
    assert agents() == Agents(1, (0, 0), 4) != agents(end=(1.0, 0.0))


@pytest.mark.parametrize(
    "arguments, message",
    [
        ({"agents": [agents()], "n_agents": 1}, "n_agents: given as well as agents"),
        ({"agents": [agents()], "depot": (0, 0)}, "depot: given as well as agents"),
        ({"agents": []}, "agents: expected at least one entry"),
        ({"agents": [{"count": 1}]}, "agents[0]: expected Agents, found dict"),
        ({"n_agents": 1, "max_speed": 4.0}, "depot: missing; give n_agents, depot and max_speed, or agents"),
    ],
)
def test_agents_are_given_in_one_of_two_ways(arguments, message):
    with pytest.raises(InputError) as caught:
        Instance([still(1, 1)], horizon=100.0, **arguments)
    assert str(caught.value).startswith(message)


# --- Bad input -------------------------------------------------------------------------------------------------------


def _with(**fields):
    return json.dumps(GOOD.to_dict() | fields)


def _with_target(**fields):
    return _with(targets=[GOOD.targets[0].to_dict() | fields])


def _without(field):
    return json.dumps({name: value for name, value in GOOD.to_dict().items() if name != field})


# name: (text of the file, how the message goes on after the file's name)
BAD = {
    "an empty file": ("", "not JSON"),
    "not JSON": ("{", "not JSON"),
    "not an object": ("[1, 2]", "expected a JSON object"),
    "nested without end": ("[" * 100_000, "maximum recursion"),
    "another format": (_with(format="mamttsp-solution"), "format: expected"),
    "no format": (_without("format"), "format: expected"),
    "another version": (_with(version=3), "version: expected 1 or 2, found 3"),
    "types in version 1": (_with(agents=[]), "agents: not a field of version 1, which has n_agents, depot, max_speed"),
    "a demand in version 1": (_with_target(demand=1), "targets[0].demand: not a field of version 1"),
    "no targets field": (_without("targets"), "targets: missing"),
    "no depot": (_without("depot"), "depot: missing"),
    "no targets": (_with(targets=[]), "targets: expected at least one"),
    "targets of the wrong kind": (_with(targets={"a": 1}), "targets: expected a list"),
    "a target of the wrong kind": (_with(targets=[3]), "targets[0]: expected an object"),
    "a target without windows": (
        _with(targets=[{"times": [0, 1], "points": [[0, 0], [1, 1]]}]),
        "targets[0].windows: missing",
    ),
    "NaN": (_with(depot=[0.0, math.nan]), "NaN is not a number"),
    "Infinity": (_with(horizon=math.inf), "Infinity is not a number"),
    "a number beyond a float": (
        _with(horizon=100).replace('"horizon": 100', '"horizon": 1e999'),
        "horizon: expected a finite",
    ),
    "a whole number beyond a float": (_with(depot=[0, 10**400]), "depot: expected numbers"),
    "no agents": (_with(n_agents=0), "n_agents: expected a whole number of at least 1, found 0"),
    "half an agent": (_with(n_agents=1.5), "n_agents: expected a whole number"),
    "agents in words": (_with(n_agents="two"), "n_agents: expected a whole number"),
    "a yes for agents": (_with(n_agents=True), "n_agents: expected a whole number"),
    "a horizon of zero": (_with(horizon=0), "horizon: expected a finite number above 0"),
    "a negative speed": (_with(max_speed=-4), "max_speed: expected a finite number above 0"),
    "a depot in space": (_with(depot=[0, 0, 0]), "depot: expected the shape 2, found 3"),
    "a depot in words": (_with(depot=["0", "0"]), "depot: expected numbers"),
    "times that stand still": (_with_target(times=[50, 50]), "targets[0].times[1]: 50 does not come after 50"),
    "times that go back": (_with_target(times=[100, 0]), "targets[0].times[1]: 0 does not come after 100"),
    "one breakpoint": (_with_target(times=[0], points=[[0, 0]]), "targets[0].times: expected at least 2"),
    "a point too many": (_with_target(points=[[0, 0]] * 3), "targets[0].points: expected one for each of the 2"),
    "points on a line": (_with_target(points=[0, 1]), "targets[0].points: expected the shape Kx2, found 2"),
    "ragged points": (_with_target(points=[[0, 0], [1]]), "targets[0].points: expected numbers in the shape Kx2"),
    "points of null": (_with_target(points=[[0, 0], [1, None]]), "targets[0].points: "),
    "no windows": (_with_target(windows=[]), "targets[0].windows: expected"),
    "one window without its list": (_with_target(windows=[10, 30]), "targets[0].windows: expected the shape Kx2"),
    "a window reversed": (_with_target(windows=[[30, 10]]), "targets[0].windows[0]: ends at 10 before it starts at 30"),
    "windows that overlap": (_with_target(windows=[[10, 30], [20, 40]]), "targets[0].windows[1]: starts at 20 before"),
    "windows out of order": (_with_target(windows=[[60, 80], [10, 30]]), "targets[0].windows[1]: starts at 10 before"),
    "a window past the path": (_with_target(windows=[[90, 101]]), "targets[0].windows[0]: (90, 101) is not covered"),
    "a window before the path": (_with_target(times=[20, 100]), "targets[0].windows[0]: (10, 30) is not covered"),
    "a window past the horizon": (_with(horizon=70), "targets[0].windows: expected times from 0 to the horizon 70"),
    "a window before time 0": (
        _with_target(times=[-10, 100], windows=[[-5, 30]]),
        "targets[0].windows: expected times from 0",
    ),
    "a target faster than the agents": (
        _with_target(points=[[0, 0], [500, 0]]),
        "targets[0].points: speed 5 is not below max_speed 4",
    ),
    "a target as fast as the agents": (
        _with_target(points=[[0, 0], [400, 0]]),
        "targets[0].points: speed 4 is not below",
    ),
}


# --- Bad input of version 2 ------------------------------------------------------------------------------------------


def _two(**fields):
    return json.dumps(UNLIKE.to_dict() | fields)


def _two_with_entry(*without, **fields):
    entry = {name: value for name, value in UNLIKE.to_dict()["agents"][1].items() if name not in without}
    return _two(agents=[UNLIKE.to_dict()["agents"][0], entry | fields])


def _two_with_target(**fields):
    return _two(targets=[UNLIKE.to_dict()["targets"][0] | fields])


BAD |= {
    "version 2 without agents": (
        json.dumps({k: v for k, v in UNLIKE.to_dict().items() if k != "agents"}),
        "agents: missing",
    ),
    "version 2 with a depot": (_two(depot=[0, 0]), "depot: not a field of version 2, which has agents"),
    "version 2 with a number of agents": (_two(n_agents=3), "n_agents: not a field of version 2"),
    "version 2 with a speed": (_two(max_speed=4.0), "max_speed: not a field of version 2"),
    "types of the wrong kind": (_two(agents={"count": 1}), "agents: expected a list of entries"),
    "no types": (_two(agents=[]), "agents: expected at least one entry"),
    "a type of the wrong kind": (_two(agents=[7]), "agents[0]: expected an object with count, depot and max_speed"),
    "a type without a count": (_two_with_entry("count"), "agents[1].count: missing"),
    "a type without a depot": (_two_with_entry("depot"), "agents[1].depot: missing"),
    "a type without a speed": (_two_with_entry("max_speed"), "agents[1].max_speed: missing"),
    "a type of nobody": (_two_with_entry(count=0), "agents[1].count: expected a whole number of at least 1, found 0"),
    "a type of one and a half": (_two_with_entry(count=1.5), "agents[1].count: expected a whole number"),
    "a type with a depot in space": (
        _two_with_entry(depot=[0, 0, 0]),
        "agents[1].depot: expected the shape 2, found 3",
    ),
    "a type that stands still": (_two_with_entry(max_speed=0), "agents[1].max_speed: expected a finite number above 0"),
    "a type with half an end": (_two_with_entry(end=[1]), "agents[1].end: expected the shape 2, found 1"),
    "a type with an end in words": (_two_with_entry(end="home"), "agents[1].end: expected numbers in the shape 2"),
    "a capacity below 0": (_two_with_entry(capacity=-1), "agents[1].capacity: expected a finite number of at least 0"),
    "a capacity in words": (_two_with_entry(capacity="all"), "agents[1].capacity: expected a finite number"),
    "a misspelt capacity": (_two_with_entry(capcity=5), "agents[1].capcity: unknown; an entry has count, depot"),
    "a demand below 0": (
        _two_with_target(demand=-1),
        "targets[0].demand: expected a finite number of at least 0, found -1",
    ),
    "a demand in words": (_two_with_target(demand="two"), "targets[0].demand: expected a finite number of at least 0"),
    "a demand of null": (_two_with_target(demand=None), "targets[0].demand: expected a finite number of at least 0"),
    "a target faster than the slowest type": (
        _two_with_target(points=[[0, 0], [500, 0]]),
        "targets[0].points: speed 5 is not below agents[0].max_speed 4; agents must be faster",
    ),
}


@pytest.fixture(params=BAD)
def bad(request, tmp_path):
    """A bad file, and how the message about it goes on after the file's name."""
    text, message = BAD[request.param]
    path = tmp_path / "bad.json"
    path.write_text(text)
    return path, message


def test_bad_input_is_refused_in_one_line_that_names_file_and_field(bad):
    path, message = bad
    with pytest.raises(InputError) as caught:
        Instance.read(path)
    assert str(caught.value).startswith(f"{path}: {message}")
    assert len(str(caught.value).splitlines()) == 1


def test_bad_input_ends_the_command_line_with_status_2_and_the_same_line(bad, capsys):
    path, message = bad
    assert main(["solve", str(path)]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.startswith(f"{path}: {message}") and len(err.splitlines()) == 1


@pytest.mark.parametrize(
    "name, message", [("missing", "No such file"), (".", "Is a directory"), ("binary", "invalid start byte")]
)
def test_what_cannot_be_read_is_named(name, message, tmp_path):
    (tmp_path / "binary").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(InputError, match=f"cannot be read: .*{message}") as caught:
        Instance.read(tmp_path / name)
    assert str(caught.value).startswith(f"{tmp_path / name}: ") and len(str(caught.value).splitlines()) == 1


def test_the_real_command_prints_no_traceback(tmp_path):
    path = tmp_path / "bad.json"
    path.write_text(BAD["NaN"][0])
    run = subprocess.run([sys.executable, "-m", "mamttsp", "solve", path], capture_output=True, text=True, check=False)
    assert run.returncode == 2 and run.stdout == ""
    assert run.stderr == f"{path}: NaN is not a number that JSON allows; every value must be finite\n"


@pytest.mark.parametrize("method", ["exact", "micp"])
def test_an_instance_without_solution_is_no_error_but_no_answer(method, tmp_path):
    path, answer = tmp_path / "instance.json", tmp_path / "solution.json"
    instance(still(10, 0, [(5, 6)]), still(-10, 0, [(5, 6)])).write(path)
    assert main(["solve", str(path), "--method", method, "-o", str(answer)]) == 1
    assert json.loads(answer.read_text())["status"] == "infeasible"
    assert main(["solve", str(path), "--method", method, "-o", str(answer), "--agents", "2"]) == 0
    assert main(["check", str(path), str(answer), "--agents", "2"]) == 0
