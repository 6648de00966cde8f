"""The checker against every kind of damage, and tours in files."""

import dataclasses

import pytest
from examples import instance, moving, still

from mamttsp import InputError, Solution, Tour, TourError, Visit, check
from mamttsp.tours import TOLERANCE

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


def test_a_tour_survives_its_json():
    tour = _good()[0]
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
