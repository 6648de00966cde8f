"""The generator has every property that Section V-A names, and gives the same instances everywhere."""

import dataclasses
import hashlib
import json
import math
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mamttsp import Agents, InputError, Instance, Tour, Visit, check, generate, paper_instance
from tests.oracle import optimum

WINDOWS = (20, 40, 60)
seeds = st.integers(0, 10_000)
sizes = st.integers(1, 15)


@given(sizes, seeds, st.sampled_from(WINDOWS))
def test_the_paper_s_numbers(n, seed, total_window):
    instance = generate(n, total_window, n_agents=2, seed=seed)
    assert (instance.n_targets, instance.n_agents, instance.max_speed, instance.horizon) == (n, 2, 4.0, 150.0)
    assert instance.depot.tolist() == [0.0, 0.0]
    assert pytest.approx(math.hypot(100.0, 100.0)) == instance.R  # the diagonal of the square


@given(sizes, seeds)
def test_targets_keep_one_speed_in_the_range_and_stay_inside_the_square(n, seed):
    for target in generate(n, 40, seed=seed).targets:
        assert np.ptp(target.speeds) < 1e-7
        assert target.speeds.min() >= 0.5 - 1e-7 and target.speeds.max() <= 1 + 1e-7
        assert np.abs(target.points).max() <= 50
        assert target.times[0] == 0 and target.times[-1] == 150 and len(target.times) == 5


@given(sizes, seeds, st.sampled_from(WINDOWS))
def test_each_target_has_two_equal_windows_apart_from_each_other(n, seed, total_window):
    for target in generate(n, total_window, seed=seed).targets:
        (a, b), (c, d) = target.windows
        assert b - a == pytest.approx(total_window / 2, abs=1e-7) and d - c == pytest.approx(total_window / 2, abs=1e-7)
        assert 0 <= a < b <= c + 1e-7 and d <= 150


@given(sizes, seeds)
def test_longer_windows_contain_the_shorter_ones(n, seed):
    short, middle, long = (generate(n, total_window, seed=seed) for total_window in WINDOWS)
    for inner, outer in ((short, middle), (middle, long)):
        for small, large in zip(inner.targets, outer.targets):
            assert (large.windows[:, 0] <= small.windows[:, 0] + 1e-7).all()
            assert (large.windows[:, 1] >= small.windows[:, 1] - 1e-7).all()


@given(sizes, seeds, st.sampled_from(WINDOWS), st.integers(1, 5))
def test_trajectories_depend_on_neither_windows_nor_agents(n, seed, total_window, n_agents):
    reference, other = generate(n, 20, seed=seed), generate(n, total_window, n_agents, seed=seed)
    for a, b in zip(reference.targets, other.targets):
        assert (a.times == b.times).all() and (a.points == b.points).all()


@pytest.mark.parametrize("n", (5, 10, 15, 20))
@pytest.mark.parametrize("seed", range(3))
def test_one_agent_suffices(n, seed, monkeypatch):
    """The random tour behind the windows, flown at v_max, passes the checker for every window length."""
    module = sys.modules["mamttsp.generate"]
    visits, draw = [], module._random_tour
    monkeypatch.setattr(module, "_random_tour", lambda *given: visits.append(draw(*given)) or visits[-1])
    for total_window in WINDOWS:
        instance = generate(n, total_window, seed=seed)
        times = visits.pop()
        tour = [Visit(int(u), times[u], tuple(instance.targets[u].position(times[u]))) for u in np.argsort(times)]
        home = tour[-1].time + np.linalg.norm(tour[-1].position) / 4.0
        length = check(instance, [Tour(tuple(tour), home)])
        assert length <= 4.0 * home + 1e-6


@pytest.mark.parametrize("seed", range(3))
def test_one_agent_suffices_by_enumeration(seed):
    lengths = [optimum(generate(4, total_window, seed=seed)) for total_window in WINDOWS]
    assert np.isfinite(lengths).all() and lengths == sorted(lengths, reverse=True)


@given(st.integers(5, 15), seeds)
def test_a_tour_among_all_targets_is_the_papers(n, seed):
    spread, near = (generate(n, 20, seed=seed, horizon=300.0, n_pieces=8, nearest=k) for k in (None, 1))
    assert all((a.points == b.points).all() for a, b in zip(spread.targets, near.targets)) and near != spread
    assert generate(n, 20, seed=seed, horizon=300.0, n_pieces=8, nearest=n) == spread


@pytest.mark.parametrize("nearest", (1, 2, 3))
def test_the_tour_among_near_targets_is_flown_and_crowds_the_windows_early(nearest, monkeypatch):
    module = sys.modules["mamttsp.generate"]
    visits, draw = [], module._random_tour
    monkeypatch.setattr(module, "_random_tour", lambda *given: visits.append(draw(*given)) or visits[-1])
    for seed in range(5):
        visits.clear()
        generate(12, 20, seed=seed)
        instance = generate(12, 20, seed=seed, nearest=nearest)
        spread, near = visits
        assert near.max() < spread.max()
        tour = [Visit(int(u), near[u], tuple(instance.targets[u].position(near[u]))) for u in np.argsort(near)]
        assert check(instance, [Tour(tuple(tour), tour[-1].time + np.linalg.norm(tour[-1].position) / 4.0)]) > 0


TYPES = [Agents(1, (30.0, -30.0), 3.0, end=(0.0, 40.0), capacity=2.0), Agents(2, (0.0, 0.0), 5.0)]


@given(sizes, seeds, st.sampled_from(WINDOWS))
def test_types_and_demands_leave_the_trajectories(n, seed, total_window):
    plain, unlike = (
        generate(n, total_window, seed=seed),
        generate(n, total_window, seed=seed, agents=TYPES, demands=1.5),
    )
    assert unlike.agents == tuple(TYPES) and [target.demand for target in unlike.targets] == [1.5] * n
    for a, b in zip(plain.targets, unlike.targets):
        assert (a.times == b.times).all() and (a.points == b.points).all()


def test_agents_of_the_papers_kind_change_nothing():
    assert generate(5, 40, seed=3, agents=[Agents(2, (0, 0), 4.0)], demands=[0.0] * 5) == generate(5, 40, 2, seed=3)


@pytest.mark.parametrize("seed", range(3))
def test_one_agent_of_the_first_type_could_fly_a_tour_by_enumeration(seed):
    first = dataclasses.replace(TYPES[0], capacity=None)
    instance = generate(3, 20, seed=seed, agents=TYPES, demands=[1, 1, 1])
    assert np.isfinite(optimum(Instance(instance.targets, agents=[first], horizon=instance.horizon)))


def test_different_seeds_and_sizes_give_different_targets():
    first_points = {tuple(generate(n, 20, seed=seed).targets[0].points[0]) for n in (3, 4) for seed in range(5)}
    assert len(first_points) == 10


def test_the_paper_s_instances_go_by_name():
    assert paper_instance(n=10, index=3, total_window=60, n_agents=4) == generate(10, 60, 4, seed=3)


# Of the JSON without R and with six decimals, so that the last bits of a machine's arithmetic do not count.
FINGERPRINTS = {
    (5, 0): "275714cd6cf70ebf",
    (10, 7): "ac4b5f7734551330",
    (15, 13): "75cfddc9a70639a4",
    (20, 19): "594fe7b665762172",
}


@pytest.mark.parametrize("n, index", FINGERPRINTS)
def test_instances_are_the_same_on_every_machine(n, index):
    assert fingerprint(paper_instance(n, index)) == FINGERPRINTS[n, index]


def fingerprint(instance):
    """Return a short hash of the instance, rounded to six decimals."""

    def rounded(value):
        if isinstance(value, float):
            return f"{value + 0.0:.6f}"
        if isinstance(value, dict):
            return {name: rounded(item) for name, item in value.items()}
        return [rounded(item) for item in value] if isinstance(value, list) else value

    text = json.dumps(rounded(dataclasses.replace(instance, R=None).to_dict()), sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


@pytest.mark.parametrize(
    "arguments, field",
    [
        ({"n_targets": 0}, "n_targets"),
        ({"n_targets": 2.0}, "n_targets"),
        ({"n_agents": 0}, "n_agents"),
        ({"seed": -1}, "seed"),
        ({"seed": "a"}, "seed"),
        ({"total_window": 0}, "total_window"),
        ({"total_window": 61}, "total_window"),
        ({"total_window": float("nan")}, "total_window"),
        ({"horizon": 80}, "widest_total_window"),
        ({"horizon": -1}, "horizon"),
        ({"side": 0}, "side"),
        ({"max_speed": float("inf")}, "max_speed"),
        ({"max_speed": 1.0}, "target_speed"),
        ({"target_speed": (1.0, 0.5)}, "target_speed"),
        ({"target_speed": 1.0}, "target_speed"),
        ({"n_pieces": 0}, "n_pieces"),
        ({"n_pieces": 1}, "n_pieces"),  # a piece of 150 s may be longer than the square has room for
        ({"max_tries": 0}, "max_tries"),
        ({"nearest": 0}, "nearest"),
        ({"nearest": 1.5}, "nearest"),
        ({"agents": []}, "agents"),
        ({"agents": [4.0]}, r"agents\[0\]"),
        ({"agents": TYPES, "n_agents": 2}, "agents"),
        ({"agents": TYPES, "max_speed": 5.0}, "agents"),
        ({"agents": TYPES, "target_speed": (1.0, 3.0)}, "target_speed"),  # as fast as the first type
        ({"demands": [1, 2]}, "demands"),
        ({"demands": "one"}, "demands"),
        ({"demands": -1}, "demand"),
        ({"n_targets": 60, "max_tries": 10}, "horizon"),  # nobody can visit so many in time
    ],
)
def test_bad_arguments_are_named(arguments, field):
    with pytest.raises(InputError, match=f"^{field}: ") as caught:
        generate(**{"n_targets": 3, "total_window": 20} | arguments)
    assert len(str(caught.value).splitlines()) == 1


@pytest.mark.parametrize("arguments, field", [((7, 0), "n"), ((5, 20), "index"), ((5, "0"), "index")])
def test_the_paper_has_no_other_instances(arguments, field):
    with pytest.raises(InputError, match=f"^{field}: expected"):
        paper_instance(*arguments)
