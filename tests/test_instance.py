"""Target and Instance: what they hold, their file, and every kind of bad input, in the library and on the command line."""

import dataclasses
import json
import math
import subprocess
import sys

import numpy as np
import pytest
from examples import instance, moving, still

from mamttsp import InputError, Instance, Target, build_graph, generate
from mamttsp.__main__ import main

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
    assert build_graph(GOOD).R == GOOD.size
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
    "another version": (_with(version=2), "version: expected 1, found 2"),
    "no targets field": (_without("targets"), "targets: missing"),
    "no depot": (_without("depot"), "depot: missing"),
    "no targets": (_with(targets=[]), "targets: expected at least one"),
    "targets of the wrong kind": (_with(targets={"a": 1}), "targets: expected a list"),
    "a target of the wrong kind": (_with(targets=[3]), "targets[0]: expected an object"),
    "a target without windows": (_with(targets=[{"times": [0, 1], "points": [[0, 0], [1, 1]]}]), "targets[0].windows: missing"),
    "NaN": (_with(depot=[0.0, math.nan]), "NaN is not a number"),
    "Infinity": (_with(horizon=math.inf), "Infinity is not a number"),
    "a number beyond a float": (_with(horizon=100).replace('"horizon": 100', '"horizon": 1e999'), "horizon: expected a finite"),
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
    "a target as fast as the agents": (_with_target(points=[[0, 0], [400, 0]]), "targets[0].points: speed 4 is not below"),
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


@pytest.mark.parametrize("name, message", [("missing", "No such file"), (".", "Is a directory"), ("binary", "invalid start byte")])
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
