"""Exact times along routes of targets against the earliest times of all their routes of segments."""

import itertools

import numpy as np
import pytest

from mamttsp.exact.reach import fill_reach, fits, make_motion
from mamttsp.timing import earliest_times
from tests.exact.networks import unlike

SEEDS = range(6)


def _motion(seed):
    """Return (graph, Motion) of an instance with two types of agents."""
    graph = unlike(seed, n=4, window=60)
    return graph, make_motion(graph, range(4))


def _earliest(graph, layer, route):
    """Return the earliest time at the last of the targets, in this order, and whether all can be served; over all of
    their segments."""
    clusters = [[i for i in graph.C(u) if graph.layer[i] == layer] for u in route]
    flown = [times for way in itertools.product(*clusters) if (times := earliest_times(graph, way)) is not None]
    return min((times[len(route) - 1] for times in flown), default=np.inf)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_route_can_be_flown_if_it_can_along_some_segments(seed):
    graph, motion = _motion(seed)
    early, late, told = np.zeros((5, 3)), np.zeros((5, 3)), []
    for k, length in itertools.product(range(graph.n_layers), range(1, 5)):
        for order in itertools.permutations(range(4)):
            expected = _earliest(graph, k, order[:length])
            row = np.array(order)
            told.append(fill_reach(row, length, motion, k, early, late, 0, 0))
            assert told[-1] == np.isfinite(expected)
            if told[-1]:
                assert early[length, 2] == pytest.approx(expected)
                for i in range(1, length + 1):  # no later than it may be, at every stop
                    assert early[i, 2] <= motion.slack - late[length - i + 1, 2]
    assert 0 < sum(told) < len(told)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_visit_fits_in_if_the_longer_route_can_be_flown(seed):
    graph, motion = _motion(seed)
    early, late, told = np.zeros((5, 3)), np.zeros((5, 3)), []
    for k, order in itertools.product(range(graph.n_layers), itertools.permutations(range(4))):
        *route, w = order
        if not fill_reach(np.array(order), 3, motion, k, early, late, 0, 0):
            continue
        for i in range(4):
            behind = route[i] if i < 3 else 4
            latest = motion.slack - late[3 - i, 2]
            told.append(fits(w, behind, early[i], latest, motion.first, motion.ahead[k], motion.speed[k]))
            assert told[-1] == np.isfinite(_earliest(graph, k, [*route[:i], w, *route[i:]]))
    assert 0 < sum(told) < len(told)


@pytest.mark.parametrize("seed", SEEDS)
def test_what_holds_already_is_not_filled_in_anew(seed):
    graph, motion = _motion(seed)
    rng, row = np.random.default_rng(seed), np.arange(4)
    for k in range(graph.n_layers):
        early, late = rng.random((2, 5, 3))
        whole = [np.zeros((5, 3)), np.zeros((5, 3))]
        fill_reach(row, 4, motion, k, *whole, 0, 0)
        early[:3], late[:2] = whole[0][:3], whole[1][:2]
        fill_reach(row, 4, motion, k, early, late, 2, 1)
        assert np.array_equal(early, whole[0]) and np.array_equal(late, whole[1])
