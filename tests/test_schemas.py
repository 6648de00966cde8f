"""The JSON Schemas agree with the readers: what the library writes is valid, and what a schema refuses is refused."""

import json

import jsonschema
import pytest

from mamttsp import InputError, Instance, Solution, Tour, Visit, generate, solve
from mamttsp.library import FOLDER, parameters
from mamttsp.schemas import schema
from tests.examples import agents, general, moving, still
from tests.test_instance import BAD

VALID = jsonschema.Draft202012Validator
UNLIKE = general(
    still(1, 1, demand=2.0), moving((9, 9), (0, 0.2)), types=[agents(2), agents(1, end=(3.0, 3.0), capacity=4.0)]
)

#: what only the reader sees: relations between numbers, and what is no JSON for others either
BEYOND = (
    "an empty file", "not JSON", "nested without end", "NaN", "Infinity", "a number beyond a float",
    "a whole number beyond a float", "times that stand still", "times that go back", "a point too many",
    "a window reversed",
    "windows that overlap", "windows out of order", "a window past the path", "a window before the path",
    "a window past the horizon", "a window before time 0", "a target faster than the agents",
    "a target as fast as the agents", "a target faster than the slowest type",
)  # fmt: skip


def errors(kind, data):
    return [error.message for error in VALID(schema(kind)).iter_errors(data)]


@pytest.mark.parametrize("kind", ("instance", "solution"))
def test_they_are_schemas(kind):
    VALID.check_schema(schema(kind))


@pytest.mark.parametrize("instance", [generate(4, 20, 2, seed=1), UNLIKE], ids=("version 1", "version 2"))
def test_what_is_written_is_valid(instance):
    assert errors("instance", instance.to_dict()) == []
    assert errors("solution", solve(instance, method="micp").to_dict()) == []


def test_every_instance_of_the_library_is_valid():
    validator = VALID(schema("instance"))
    for name in list(parameters())[::7]:
        assert validator.is_valid(json.loads((FOLDER / f"{name}.json").read_text())), name


def test_the_library_s_best_solutions_are_valid():
    validator, paths = VALID(schema("solution")), sorted((FOLDER / "best").glob("*.json"))
    assert len(paths) >= 560
    for path in paths[::7]:
        assert validator.is_valid(json.loads(path.read_text())), path.name


@pytest.mark.parametrize("case", [case for case in BAD if case not in BEYOND])
def test_what_a_reader_refuses_for_its_kind_the_schema_refuses(case):
    data = json.loads(BAD[case][0])
    with pytest.raises(InputError):
        Instance.from_dict(data)
    assert errors("instance", data)


@pytest.mark.parametrize(
    "change",
    [{"version": 3}, {"status": "great"}, {"objective": "low"}, {"tours": {}}, {"tours": [None]}, {"format": "other"}],
)
def test_bad_solutions_are_refused_by_both(change):
    solution = Solution("feasible", 9.0, 1.0, 0.5, (Tour((Visit(0, 1.0, (1.0, 1.0)),), 2.0),), "exact", "none")
    assert errors("solution", solution.to_dict()) == []
    assert errors("solution", solution.to_dict() | change)
    with pytest.raises(InputError):
        Solution.from_dict(solution.to_dict() | change)


def test_version_2_of_a_solution_names_types():
    tour = {"visits": [], "return_time": 0.0}
    data = Solution("feasible", 9.0, 1.0, 0.5, (), "exact", "none").to_dict() | {"version": 2}
    assert errors("solution", data | {"tours": [tour]}) and not errors(
        "solution", data | {"tours": [tour | {"agent": 1}]}
    )
