"""The checker against every kind of damage, and tours in files."""

import dataclasses

import pytest

from mamttsp import InputError, Solution, Tour, TourError, Visit, check
from mamttsp.tours import TOLERANCE
from tests.examples import agents, general, instance, moving, still

CHECKED = instance(
    moving((10, 0), (0, 1), [(5, 15), (30, 50)]),
    still(0, 20, [(0, 60)]),
    moving((-20, 0), (0.5, 0), [(10, 40)]),
    n_agents=2,
)


def _good():
    """Return two tours of CHECKED: targets 0 and 1 at leisure, and target 2 by the other agent."""
    first = Tour((Visit(0, 10.0, (10.0, 10.0)), Visit(1, 20.0, (0.0, 20.0))), 30.0)
    return [first, Tour((Visit(2, 20.0, (-10.0, 0.0)),), 30.0)]


def _change(tours, tour, visit=None, **changes):
    """Return the tours with some fields of one tour, or of one of its visits, changed."""
    tours = list(tours)
    if visit is not None:
        visits = list(tours[tour].visits)
        visits[visit] = dataclasses.replace(visits[visit], **changes)
        changes = {"visits": tuple(visits)}
    tours[tour] = dataclasses.replace(tours[tour], **changes)
    return tours


def test_good_tours_have_their_length():
    root2 = 2**0.5
    assert check(CHECKED, _good()) == pytest.approx(10 * root2 + 10 * root2 + 20 + 20)


def test_an_idle_agent_may_be_given_an_empty_tour():
    assert check(CHECKED.with_agents(3), [*_good(), Tour((), 0.0)]) == check(CHECKED, _good())


DAMAGE = {
    "a missed target": (_good()[:1], "target 2 is visited 0 times"),
    "a target twice": (_change(_good(), 1, visits=_good()[1].visits * 2), "target 2 is visited 2 times"),
    "a target that is not there": (_change(_good(), 1, 0, target=3), "target 3 does not exist"),
    "a target of a negative number": (_change(_good(), 1, 0, target=-1), "target -1 does not exist"),
    "a visit before its window": (_change(_good(), 1, 0, time=9.0, position=(-15.5, 0.0)), "outside its windows"),
    "a visit between two windows": (_change(_good(), 0, 0, time=16.0, position=(10.0, 16.0)), "outside its windows"),
    "a visit off the path": (_change(_good(), 1, 0, position=(-10.0, 0.1)), "0.1 units off its path"),
    "a visit that is nowhere": (_change(_good(), 1, 0, position=(float("nan"), 0.0)), "off its path"),
    "a visit at no time": (_change(_good(), 1, 0, time=float("nan")), "outside its windows"),
    "too fast a hop": (_change(_good(), 0, 1, time=13.0), "faster than max_speed 4"),
    "a hop back in time": (_change(_good(), 0, 1, time=9.0), "faster than max_speed 4"),
    "too fast a way home": (_change(_good(), 1, return_time=22.0), "to the depot: 10 units in 2 s"),
    "a late return": (_change(_good(), 1, return_time=101.0), "after the horizon 100"),
    "no return": (_change(_good(), 1, return_time=float("inf")), "after the horizon 100"),
    "a return at no time": (_change(_good(), 1, return_time=float("nan")), "tour 1, to the depot: 10 units in nan s"),
    "too many agents": ([*_good(), Tour((), 0.0)], "3 tours for 2 agents"),
}


@pytest.mark.parametrize("damage", DAMAGE)
def test_damage_is_rejected_and_named(damage):
    tours, message = DAMAGE[damage]
    with pytest.raises(TourError, match=message):
        check(CHECKED, tours)


# --- Types of agents -------------------------------------------------------------------------------------------------

#: two slow agents at the origin that end in the north and carry 2, and a fast one in the east
UNLIKE = general(
    still(10, 0, demand=1.0),
    still(0, 10, demand=1.5),
    still(-10, 0, demand=0.5),
    types=[agents(2, end=(0.0, 20.0), capacity=2.0), agents(1, depot=(40.0, 0.0), max_speed=8.0)],
)
WEST_NORTH = Tour((Visit(2, 2.5, (-10.0, 0.0)), Visit(1, 7.0, (0.0, 10.0))), 9.5, agent=0)
EAST = Tour((Visit(0, 3.75, (10.0, 0.0)),), 7.5, agent=1)


def test_each_type_flies_from_its_depot_to_its_end_at_its_speed():
    assert check(UNLIKE, [WEST_NORTH, EAST]) == pytest.approx(10 + 200**0.5 + 10 + 60)


def test_an_agent_without_a_visit_stays_where_it_is_and_flies_nothing():
    idle = Tour((), 0.0, agent=0)
    assert check(UNLIKE, [WEST_NORTH, EAST, idle]) == check(UNLIKE, [WEST_NORTH, EAST])


ALONE = [Tour((Visit(u, t, p),), home, agent=0) for u, t, p, home in (
    (0, 2.5, (10.0, 0.0), 9.0), (1, 2.5, (0.0, 10.0), 5.0), (2, 2.5, (-10.0, 0.0), 9.0),
)]  # fmt: skip
UNLIKE_DAMAGE = {
    "from another depot": (
        [dataclasses.replace(EAST, agent=0), WEST_NORTH],
        "tour 0, to its end: .* faster than max_speed 4",
    ),
    "back at the depot, not at the end": (
        _change([WEST_NORTH, EAST], 0, return_time=9.4),
        "to its end: 10 units in 2.4 s",
    ),
    "too fast for its type": (
        _change([WEST_NORTH, EAST], 0, 1, time=5.0),
        "14.1.* units in 2.5 s, faster than max_speed 4",
    ),
    "too fast even for the fast type": (
        _change([WEST_NORTH, EAST], 1, 0, time=3.7),
        "30 units in 3.7 s, faster than max_speed 8",
    ),
    "a type used too often": (ALONE, "3 tours for 2 agents of type 0"),
    "idle agents that are not there": ([WEST_NORTH, EAST, Tour((), 0.0, 1)], "2 tours for 1 agent of type 1"),
    "a type that does not exist": (
        _change([WEST_NORTH, EAST], 1, agent=2),
        "tour 1: agent 2 does not exist; there are 2 types",
    ),
    "a type below 0": (_change([WEST_NORTH, EAST], 1, agent=-1), "tour 1: agent -1 does not exist"),
    "no type": (_change([WEST_NORTH, EAST], 1, agent=None), "tour 1: its agent's type is not named; there are 2 types"),
    "too much load": (
        [Tour((Visit(0, 2.5, (10.0, 0.0)), Visit(1, 7.0, (0.0, 10.0))), 9.5, 0), dataclasses.replace(ALONE[2])],
        "tour 0: demands of 2.5 in all, above the capacity 2",
    ),
}


@pytest.mark.parametrize("damage", UNLIKE_DAMAGE)
def test_damage_to_tours_of_types_is_rejected_and_named(damage):
    tours, message = UNLIKE_DAMAGE[damage]
    with pytest.raises(TourError, match=message) as caught:
        check(UNLIKE, tours)
    assert len(str(caught.value).splitlines()) == 1


def test_a_load_that_is_full_to_the_last_bit_is_no_fault():
    tenths = general(*(still(10, y, demand=0.1) for y in (0, 1, 2)), types=[agents(capacity=0.3)])
    stops = tuple(Visit(u, 2.5 + u, (10.0, float(u))) for u in range(3))
    assert check(tenths, [Tour(stops, 10.0)]) > 0


def test_every_violation_is_listed():
    tours = _change(_change(_good(), 0, 0, time=16.0, position=(10.0, 16.0)), 1, return_time=101.0)
    with pytest.raises(TourError) as caught:
        check(CHECKED, tours)
    assert len(str(caught.value).splitlines()) == 2


@pytest.mark.parametrize("share, accepted", [(0.9, True), (1.1, False)])
@pytest.mark.parametrize("what", ["window", "path", "return", "speed"])
def test_the_tolerance_is_a_share_of_the_horizon_and_of_the_size(what, share, accepted):
    late, off = share * TOLERANCE * CHECKED.horizon, share * TOLERANCE * CHECKED.size
    tours = {
        "window": _change(_good(), 0, 0, time=15 + late, position=(10.0, 15 + late)),
        "path": _change(_good(), 1, 0, position=(-10.0, off)),
        "return": _change(_good(), 1, return_time=100 + late),
        "speed": _change(_good(), 1, return_time=22.5 - late),
    }[what]
    if accepted:
        assert check(CHECKED, tours) > 0
    else:
        with pytest.raises(TourError):
            check(CHECKED, tours)


@pytest.mark.parametrize("m", (1, 2))
def test_the_checker_needs_no_solver_to_agree_with_a_tour_flown_by_hand(m):
    # A stationary target 30 units away: 7.5 s there, 7.5 s back.
    far = instance(still(30, 0), n_agents=m)
    assert check(far, [Tour((Visit(0, 7.5, (30.0, 0.0)),), 15.0)]) == 60.0
    with pytest.raises(TourError, match="faster"):
        check(far, [Tour((Visit(0, 7.4, (30.0, 0.0)),), 15.0)])


# --- Files -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("agent", [None, 0, 3])
def test_a_tour_survives_its_json(agent):
    tour = dataclasses.replace(_good()[0], agent=agent)
    assert Tour.from_dict(tour.to_dict()) == tour


@pytest.mark.parametrize(
    "data, field",
    [
        ([], "tour"),
        ({"visits": []}, "tour"),
        ({"visits": 3, "return_time": 1.0}, "tour"),
        ({"visits": [], "return_time": "soon"}, "tour"),
        ({"visits": [], "return_time": True}, "tour"),
        ({"visits": [], "return_time": 10**400}, "tour"),
        ({"visits": [7], "return_time": 1.0}, r"tour.visits\[0\]"),
        ({"visits": [{"target": 0, "time": 1.0}], "return_time": 1.0}, r"tour.visits\[0\]"),
        ({"visits": [{"target": 0.5, "time": 1.0, "position": [1, 2]}], "return_time": 1.0}, r"tour.visits\[0\]"),
        ({"visits": [{"target": 0, "time": 1.0, "position": [1, 2, 3]}], "return_time": 1.0}, r"tour.visits\[0\]"),
        ({"visits": [{"target": 0, "time": 1e999, "position": [1, 2]}], "return_time": 1.0}, r"tour.visits\[0\]"),
    ],
)
def test_a_bad_tour_in_a_file_is_named(data, field):
    with pytest.raises(InputError, match=f"^{field}: expected"):
        Tour.from_dict(data)


# --- What a person may give ------------------------------------------------------------------------------------------


def test_a_solution_is_checked_as_its_tours_are():
    solution = Solution("feasible", 1.0, None, 1.0, tuple(_good()), "exact", "none")
    assert check(CHECKED, solution) == check(CHECKED, _good())


@pytest.mark.parametrize(
    "tours, message",
    [
        (3, "tours: expected a Solution or a list of Tours, found 3"),
        (None, "tours: expected a Solution or a list of Tours, found None"),
        ("tours.json", "tours: expected a Solution or a list of Tours, found 'tours.json'"),
        ({}, "tours: expected a Solution or a list of Tours, found {}"),
        (_good()[0], "tours: expected a Solution or a list of Tours, found Tour"),
        ([{}], "tours[0]: expected a Tour"),
        ([Tour(3, 1.0)], "tours[0]: expected a Tour"),
        ([Tour((), "soon")], "tours[0]: expected a Tour"),
        ([Tour((), 0.0), Tour((7,), 1.0)], "tours[1].visits[0]: expected a Visit"),
        ([Tour((Visit("0", 1.0, (0.0, 0.0)),), 1.0)], "tours[0].visits[0]: expected a Visit"),
        ([Tour((Visit(0, None, (0.0, 0.0)),), 1.0)], "tours[0].visits[0]: expected a Visit"),
        ([Tour((Visit(0, 1.0, 3),), 1.0)], "tours[0].visits[0]: expected a Visit"),
        ([Tour((Visit(0, 1.0, (1.0, 2.0, 3.0)),), 1.0)], "tours[0].visits[0]: expected a Visit"),
        ([Tour((Visit(0, 1.0, ("a", "b")),), 1.0)], "tours[0].visits[0]: expected a Visit"),
    ],
)
def test_what_is_no_tours_is_named_in_one_line(tours, message):
    with pytest.raises(InputError) as caught:
        check(CHECKED, tours)
    assert str(caught.value).startswith(message) and "\n" not in str(caught.value)


@pytest.mark.parametrize("given", [{"instance": {}}, {"tolerance": "small"}, {"tolerance": 0}])
def test_another_wrong_type_is_named_in_one_line(given):
    with pytest.raises(InputError, match=f"^{next(iter(given))}: expected"):
        check(**{"instance": CHECKED, "tours": _good()} | given)


def test_one_agent_is_one_agent():
    with pytest.raises(TourError, match="^2 tours for 1 agent$"):
        check(CHECKED.with_agents(1), _good())
