"""Other people's files, small ones written here: what they become, and one line for what is wrong with them."""

import json

import numpy as np
import pytest

from mamttsp import Agents, InputError, check, solve
from mamttsp.readers import read_linear_motions, read_solomon

TARGETS = {
    "A": {"px": 10.0, "py": 0.0, "vx": 0.0, "vy": 0.5, "tmin": 0.0, "tmax": 40.0, "radius": 1.0},
    "B": {"px": -5.0, "py": 5.0, "vx": 0.25, "vy": 0.0, "tmin": 20.0, "tmax": 60.0},
}
AGENT = "[depot]\npx = 1.0\npy = 2.0\n\n[param]\nT=100.0\nvmax=3.0\nR=80\n"

SOLOMON = """TINY

VEHICLE
NUMBER     CAPACITY
  {vehicles}         10

CUSTOMER
CUST NO.  XCOORD.   YCOORD.    DEMAND   READY TIME  DUE DATE   SERVICE   TIME

    0      0         0          0          0       100          0
    1      30        0          6          0        60          {service}
    2      30        40         3         70       120          0
    3      0         10         4          0       100          0
"""


@pytest.fixture
def motions(tmp_path):
    def write(targets=TARGETS, agent=AGENT):
        paths = tmp_path / "targets.json", tmp_path / "agent.toml"
        paths[0].write_text(targets if isinstance(targets, str) else json.dumps(targets))
        paths[1].write_text(agent)
        return paths

    return write


@pytest.fixture
def solomon(tmp_path):
    def write(text=SOLOMON, vehicles=2, service=0):
        path = tmp_path / "tiny.txt"
        path.write_text(text.format(vehicles=vehicles, service=service))
        return path

    return write


def test_linear_motions(motions):
    made = read_linear_motions(*motions(), n_agents=2)
    assert (made.n_agents, made.depot.tolist(), made.max_speed, made.horizon, made.R) == (2, [1, 2], 3, 100, 80)
    a, b = made.targets
    assert a.position(20.0) == pytest.approx([10.0, 10.0]) and b.position(20.0) == pytest.approx([0.0, 5.0])
    assert a.windows.tolist() == [[0, 40]] and b.windows.tolist() == [[20, 60]]
    assert check(made, solve(made)) > 0


BAD_MOTIONS = {
    "not JSON": ("{", AGENT, "targets.json: not JSON"),
    "a list": ([], AGENT, "targets.json: expected an object with a target's px"),
    "a target that is no object": ({"A": 3}, AGENT, "targets.json: A: expected an object"),
    "a target without a velocity": ({"A": {"px": 1, "py": 1}}, AGENT, "targets.json: A.vx: missing"),
    "not TOML": (TARGETS, "[depot", "agent.toml: not TOML"),
    "no depot": (TARGETS, "[param]\nT=1.0\nvmax=2.0\n", "agent.toml: depot: expected a table with px, py"),
    "no speed": (TARGETS, "[depot]\npx=0\npy=0\n[param]\nT=100\n", "agent.toml: param.vmax: missing"),
    "targets too fast": (TARGETS, AGENT.replace("vmax=3.0", "vmax=0.3"), "speed 0.5 is not below max_speed 0.3"),
    "a window after the end": (TARGETS, AGENT.replace("T=100.0", "T=50.0"), "targets[1].windows"),
}


@pytest.mark.parametrize("case", BAD_MOTIONS)
def test_bad_motions_are_one_line(motions, case):
    targets, agent, message = BAD_MOTIONS[case]
    with pytest.raises(InputError) as caught:
        read_linear_motions(*motions(targets, agent))
    assert message in str(caught.value) and len(str(caught.value).splitlines()) == 1


def test_files_that_are_not_there(tmp_path, motions):
    with pytest.raises(InputError, match="agent.toml: cannot be read"):
        read_linear_motions(motions()[0], tmp_path / "no" / "agent.toml")
    with pytest.raises(InputError, match="nowhere.txt: cannot be read"):
        read_solomon(tmp_path / "nowhere.txt")


def test_vehicles_customers_and_demands(solomon):
    made = read_solomon(solomon())
    assert made.agents == (Agents(2, (0, 0), 1.0, capacity=10.0),) and made.horizon == 100.0
    assert [target.demand for target in made.targets] == [6, 3, 4]
    assert [target.windows.tolist() for target in made.targets] == [[[0, 60]], [[70, 100]], [[0, 100]]]
    assert not any(np.any(target.speeds) for target in made.targets)


def test_the_best_tours_are_those_by_hand(solomon):
    """Customer 2 can be reached at 70, and only straight from 1 or the depot is it home by 100: 30 + 40 + 50. One
    vehicle cannot carry 1, 2 and 3, so customer 3 has one of its own: 20."""
    solution = solve(read_solomon(solomon()), method="micp")
    assert solution.status == "infeasible"  # from (30, 40), at 70 at the earliest, home is 50 away
    later = solomon(SOLOMON.replace("0       100          0\n    1", "0       130          0\n    1"))
    assert solve(read_solomon(later), method="micp").objective == pytest.approx(30 + 40 + 50 + 20)
    assert solve(read_solomon(later, n_agents=1), method="micp").status == "infeasible"


def test_service_times_are_refused_or_left_out_when_asked(solomon):
    with pytest.raises(InputError, match="ignore_service=True"):
        read_solomon(solomon(service=10))
    assert read_solomon(solomon(service=10), ignore_service=True) == read_solomon(solomon())


@pytest.mark.parametrize("text", ["", "nothing of the kind\n", SOLOMON.split("    1  ")[0]])
def test_other_text_is_refused_in_one_line(solomon, text):
    with pytest.raises(InputError, match="tiny.txt: ") as caught:
        read_solomon(solomon(text))
    assert len(str(caught.value).splitlines()) == 1
