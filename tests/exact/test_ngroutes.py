"""Values to go: below every real route's cost, in both directions of time, and the very least over all ng-routes."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mamttsp.exact import ngroutes, ngsets
from mamttsp.exact.cuts import Cuts
from mamttsp.exact.evaluation import Limits, evaluate
from mamttsp.exact.fleet import Fleet
from mamttsp.exact.legs import after_leg, before_leg, least, share_before, tangent
from mamttsp.exact.sets import to_marks, to_words
from tests.exact.networks import (
    in_full,
    load,
    network_of,
    pays,
    pieces_at,
    random_cuts,
    random_sets,
    small,
    timed_routes,
    unlike,
)  # fmt: skip

SEEDS = range(6)
WIDTHS = (50.0, 7.0)
KINDS = (small, unlike)
_NOISE = 1e-7


class _Leg:
    """Two pieces with random motions, the tangent plane between them, and the times that can be flown, on a grid."""

    def __init__(self, seed):
        self.rng = rng = np.random.default_rng(seed)
        self.speed = 4.0
        self.width = rng.choice([0.0, 0.3, 5.0, 30.0], 2)
        self.gap = rng.uniform(-self.width[1], 20.0)
        p, angle = rng.uniform(-30, 30, (2, 2)), rng.uniform(0, 2 * math.pi, 2)
        v = self.speed * rng.choice([0.0, 0.3, 0.999], 2)[:, None] * np.c_[np.cos(angle), np.sin(angle)]
        half = self.width / 2
        d, in_q, in_r = tangent(*(p[1] + half[1] * v[1] - p[0] - half[0] * v[0]), *v[0], *v[1])
        self.plane = d - in_q * half[0] - in_r * half[1], in_q, in_r
        grid = np.linspace(0, 1, 40)
        self.q, self.r = (x.ravel() for x in np.meshgrid(grid * self.width[0], grid * self.width[1]))
        self.d = np.linalg.norm(p[1] + self.r[:, None] * v[1] - p[0] - self.q[:, None] * v[0], axis=1)
        self.flown = self.d <= self.speed * (self.gap + self.r - self.q)

    def value(self, ends, piece, tau):
        """The affine function with these values at the ends of a piece (0 for q, 1 for r)."""
        width = self.width[piece]
        return ends[0] + (ends[1] - ends[0]) * (tau / width if width > 0.0 else 0.0)


@given(st.integers(0, 10**6))
def test_before_a_leg_the_line_is_below_the_leg_and_what_follows(seed):
    leg = _Leg(seed)
    ends = leg.rng.uniform(-60, 60, 2)
    ends = ends if leg.width[1] > 0.0 else np.full(2, ends[0])
    line = before_leg(*leg.plane, *ends, *leg.width, leg.gap, leg.speed)
    real = leg.d + leg.value(ends, 1, leg.r)
    assert (leg.value(line, 0, leg.q) <= real + _NOISE)[leg.flown].all()


@given(st.integers(0, 10**6))
def test_behind_a_leg_the_line_is_below_what_was_before_and_the_leg(seed):
    leg = _Leg(seed)
    ends = leg.rng.uniform(-60, 60, 2)
    ends = ends if leg.width[0] > 0.0 else np.full(2, ends[0])
    start = leg.width[0] * leg.rng.choice([0.0, leg.rng.random()])
    line = after_leg(*leg.plane, *ends, *leg.width, leg.gap, leg.speed, start, leg.rng.random())
    real = leg.value(ends, 0, leg.q) + leg.d
    allowed = leg.flown & (leg.q >= start)
    assert (leg.value(line, 1, leg.r) <= real + _NOISE)[allowed].all()


def _at(pieces, q, time, left, right):
    width = pieces.b[q] - pieces.a[q]
    return left + (right - left) * ((time - pieces.a[q]) / width if width > 0.0 else 0.0)


def _entries(lists, q):
    """Return (memory as a set, parity, load, left, right) of each entry of a piece."""
    rows = slice(lists.first[q], lists.first[q] + lists.count[q])
    memory = [set(np.flatnonzero(marks)) for marks in to_marks(lists.memory[rows], 64)]
    return list(zip(memory, lists.parity[rows], lists.load[rows], lists.left[rows], lists.right[rows]))


def _values(side, prices):
    every = ngroutes.ALL_ENTRIES
    return ngroutes.values_to_go(side, prices, 0.0, len(prices.pi), every, every, lambda: False)[0]


@pytest.mark.parametrize("seed, width, kind", list(itertools.product(SEEDS, WIDTHS, KINDS)))
def test_every_real_routes_rest_costs_at_least_its_value_to_go(seed, width, kind):
    rng, graph = np.random.default_rng(seed), kind(seed)
    network, n = network_of(graph, width), graph.n_targets
    pi, cuts = rng.uniform(0, 50, n), random_cuts(rng, n, seed % 3)
    prices = ngroutes.Prices(pi, to_words(random_sets(rng, n)), *cuts.words)
    lists, checked = _values(network.ahead, prices), 0
    for route, times, legs in timed_routes(graph, rng):
        tau = graph.tau[list(route)].tolist()
        whole, room = legs.sum() - pi[tau].sum() + pays(tau, in_full(cuts)), graph.room[graph.layer[route[0]]]
        for k, (i, time) in enumerate(zip(route, times)):
            done = tau[: k + 1]
            so_far = legs[: k + 1].sum() - pi[done].sum() + pays(done, in_full(cuts))
            odd = sum(1 << c for c, row in enumerate(cuts.rows) if row[done].sum() % 2)
            for q in pieces_at(network.pieces, i, time):
                fitting = [
                    _at(network.pieces, q, time, left, right)
                    + ngroutes.penalty(np.uint64(odd & int(parity)), cuts.words[2])
                    for memory, parity, carried, left, right in _entries(lists, q)
                    if not memory & set(done) and load(graph, route[: k + 1]) + carried <= room
                ]
                assert so_far + min(fitting, default=math.inf) <= whole + _NOISE
                checked += 1
    assert checked > 100


@pytest.mark.parametrize("seed, width, kind", list(itertools.product(SEEDS, WIDTHS, KINDS)))
def test_backward_in_time_every_real_routes_beginning_costs_at_least_its_value(seed, width, kind):
    rng, graph = np.random.default_rng(seed), kind(seed)
    network, n = network_of(graph, width), graph.n_targets
    pi = rng.uniform(0, 50, n)
    prices = ngroutes.Prices(pi, to_words(random_sets(rng, n)), *Cuts.none(n).words)
    lists, checked = _values(network.back, prices), 0
    for route, times, legs in timed_routes(graph, rng):
        tau, room = graph.tau[list(route)].tolist(), graph.room[graph.layer[route[0]]]
        for k, (i, time) in enumerate(zip(route, times)):
            real = legs[: k + 1].sum() - pi[tau[:k]].sum()
            for q in pieces_at(network.pieces, i, time):
                fitting = [
                    _at(network.pieces, q, time, right, left)  # time runs backward
                    for memory, _, carried, left, right in _entries(lists, q)
                    if not memory & set(tau[k:]) and carried + load(graph, route[k:]) <= room
                ]
                assert min(fitting, default=math.inf) <= real + _NOISE
                checked += 1
    assert checked > 100


def _legs(arcs):
    return {(q, r): leg for q, r, leg in zip(arcs.tail.tolist(), arcs.head.tolist(), arcs.leg)}


def _plain_ng_walks(network, N, longest):
    """Yield all ng-walks of up to `longest` pieces that an agent can carry, with Python's own sets."""
    pieces, after = network.pieces, {}
    for q, r in zip(network.arcs.tail.tolist(), network.arcs.head.tolist()):
        after.setdefault(q, []).append(r)
    demand = pieces.demand[pieces.layer, pieces.target]
    stack = [((q,), {pieces.target[q]}) for q in range(len(pieces.a)) if pieces.first[q, 0] < math.inf]
    while stack:
        walk, memory = stack.pop()
        yield walk
        for r in after.get(walk[-1], []) if len(walk) < longest else []:
            u = pieces.target[r]
            if u not in memory and demand[[*walk, r]].sum() <= pieces.room[pieces.layer[r]]:
                stack.append(((*walk, r), {w for w in memory if N[u, w]} | {u}))


def _cost_of_walk(network, legs, walk, pi, cuts):
    """Return the least reduced cost that the planes along a walk prove, infinite if it cannot end where it does."""
    pieces = network.pieces
    (left, right), speed = pieces.last[walk[-1]], pieces.speed[pieces.layer[walk[0]]]
    if left == math.inf:
        return math.inf
    for q, r in reversed(list(itertools.pairwise(walk))):
        widths = pieces.b[q] - pieces.a[q], pieces.b[r] - pieces.a[r]
        left, right = before_leg(*legs[q, r], left, right, *widths, pieces.a[r] - pieces.a[q], speed)
    q, targets = walk[0], pieces.target[list(walk)]
    share = share_before(pieces.ready[q], pieces.a[q], pieces.b[q] - pieces.a[q])
    value = least(pieces.first[q, 0] + left, pieces.first[q, 1] + right, share)
    return value - pi[targets].sum() + pays(targets, cuts)


@pytest.mark.parametrize("seed, kind", list(itertools.product(range(12), KINDS)))
def test_the_cheapest_start_is_the_least_over_all_ng_walks(seed, kind):
    rng, graph = np.random.default_rng(seed), kind(seed)
    network, n, longest = network_of(graph, 50.0), graph.n_targets, 6
    N, pi, cuts = random_sets(rng, n), rng.uniform(0, 40, n), random_cuts(rng, n, seed % 4)
    legs = _legs(network.arcs)
    expected = min(_cost_of_walk(network, legs, walk, pi, cuts) for walk in _plain_ng_walks(network, N, longest))
    evaluation = evaluate(network, N, pi, cuts, Fleet.of(graph), 0.0)
    assert evaluation.cheapest.min() <= expected + _NOISE
    q = int(np.argmin(evaluation.cost))
    route = ngroutes.trace(network.ahead, evaluation.prices, evaluation.lists, q, evaluation.entry[q], 3 * n)
    assert not ngsets.forbidden(network.pieces.target[route], N)
    if len(route) <= longest:
        assert evaluation.cheapest.min() == pytest.approx(expected, abs=_NOISE)
        assert _cost_of_walk(network, legs, route.tolist(), pi, cuts) == pytest.approx(expected, abs=_NOISE)


@pytest.mark.parametrize("seed, kind", list(itertools.product(SEEDS, KINDS)))
def test_no_real_route_is_shorter_than_the_length_of_its_column(seed, kind):
    """Whatever the prices, and whichever pieces of its segments its visits are in."""
    rng, graph = np.random.default_rng(seed), kind(seed)
    network, n, checked = network_of(graph, 9.0), graph.n_targets, 0
    cuts, N = random_cuts(rng, n, seed % 3), random_sets(rng, n)
    evaluation = evaluate(network, N, rng.uniform(0, 50, n), cuts, Fleet.of(graph), 0.0)
    for route, times, legs in timed_routes(graph, rng, draws=2):
        for pieces in itertools.product(*(pieces_at(network.pieces, i, t) for i, t in zip(route, times))):
            assert evaluation.length(np.array(pieces)) <= legs.sum() + _NOISE
            checked += 1
    assert checked > 50


@pytest.mark.parametrize("seed, kind", list(itertools.product(SEEDS, KINDS)))
def test_along_a_route_cuts_are_paid_as_often_as_its_targets_say(seed, kind):
    rng, graph = np.random.default_rng(seed), kind(seed)
    network, n = network_of(graph, 50.0), graph.n_targets
    cuts = random_cuts(rng, n, 4)
    inside, kept, free = cuts.with_prices(np.zeros(4)).words
    pi, N = rng.uniform(0, 50, n), to_words(np.zeros((n, n), bool))
    walks = list(itertools.islice(_plain_ng_walks(network, np.zeros((n, n), bool), 6), 400))
    walks = [np.array(walk) for walk in walks if network.pieces.last[walk[-1], 0] < math.inf]
    # Each cut costs 1 in turn: what that adds to the values is how often it is paid.
    sigmas = free - np.eye(4, 64)
    times = [
        [
            np.subtract(
                ngroutes.value_along(network.ahead, ngroutes.Prices(pi, N, inside, kept, sigma), walk),
                ngroutes.value_along(network.ahead, ngroutes.Prices(pi, N, inside, kept, free), walk),
            )
            for sigma in sigmas
        ]
        for walk in walks
    ]
    expected = cuts.paid([network.pieces.target[walk][::-1] for walk in walks])
    assert np.array(times) == pytest.approx(np.repeat(expected[:, :, None], 2, axis=2), abs=_NOISE) and expected.any()


@pytest.mark.parametrize("seed, kind", list(itertools.product(SEEDS, KINDS)))
def test_values_of_few_entries_are_those_of_some_ng_routes(seed, kind):
    """They are never below the least over all, and prove nothing."""
    rng, graph = np.random.default_rng(seed), kind(seed)
    network, n = network_of(graph, 9.0), graph.n_targets
    N, pi, cuts = random_sets(rng, n), rng.uniform(0, 50, n), random_cuts(rng, n, seed % 3)
    whole = evaluate(network, N, pi, cuts, Fleet.of(graph), 0.0)
    for most in (1, 3):
        few = evaluate(network, N, pi, cuts, Fleet.of(graph), 0.0, most)
        assert few.lists.count.max() <= most and few.bound == -math.inf
        assert (few.cost >= whole.cost - _NOISE).all() and few.value >= whole.value - _NOISE
        routes, endless = few.columns(20, 5, 3 * n)
        assert not any(ngsets.forbidden(network.pieces.target[route], N) for route in [*routes, *endless])


@pytest.mark.parametrize("seed", range(4))
def test_values_that_take_too_many_entries_or_too_long_are_given_up(seed):
    rng, graph = np.random.default_rng(seed), small(seed)
    network, n = network_of(graph, 9.0), graph.n_targets
    about = network, random_sets(rng, n), rng.uniform(0, 50, n), random_cuts(rng, n, 2), Fleet.of(graph), 0.0
    whole = evaluate(*about)
    assert evaluate(*about, None, Limits(10_000)).value == whole.value
    with pytest.raises(ngroutes.Unfinished):
        evaluate(*about, None, Limits(int(whole.lists.count.max()) - 1))
    for few in (None, 3):
        with pytest.raises(ngroutes.Unfinished):
            evaluate(*about, few, Limits(out=lambda: True))


@pytest.mark.parametrize("seed", range(8))
def test_grown_ng_sets_forbid_the_cycles_that_they_grew_from(seed):
    rng = np.random.default_rng(seed)
    N = random_sets(rng, 6)
    walks = [rng.integers(0, 6, 8) for _ in range(5)]
    walks = [walk for walk in walks if (np.diff(walk) != 0).all() and len(set(walk)) < len(walk)]
    after = ngsets.grown(walks, N, 8)
    assert (after | ~N).all() and all(ngsets.forbidden(walk, after) for walk in walks)


@pytest.mark.parametrize("seed", range(4))
def test_first_ng_sets_hold_those_that_a_route_can_fly_to_and_back_from_within_the_same_pieces_then_the_closest(seed):
    network = network_of(small(seed, 6, 60), 20.0)
    pieces, n = network.pieces, 6
    flown = list(zip(network.arcs.tail.tolist(), network.arcs.head.tolist()))
    mutual = {(int(pieces.target[q]), int(pieces.target[r])) for q, r in flown if (r, q) in set(flown)}
    least = {}
    for (q, r), (leg, *_) in zip(flown, network.arcs.leg):
        for pair in ((pieces.target[q], pieces.target[r]), (pieces.target[r], pieces.target[q])):
            least[pair] = min(least.get(pair, np.inf), leg)
    for size in range(1, n):
        N = ngsets.nearest(pieces, network.arcs, n, size)
        for u in range(n):
            others = sorted((w for w in range(n) if (u, w) in least), key=lambda w: ((u, w) not in mutual, least[u, w]))
            assert set(np.flatnonzero(N[u])) == set(others[:size])
    assert mutual


@pytest.mark.parametrize("seed", range(4))
def test_backward_in_time_arcs_are_the_same_legs(seed):
    network = network_of(small(seed, 5), 6.0)
    arcs, back, width = network.arcs, network.back, network.ahead.width
    legs = {(q, r): leg for q, r, leg in zip(arcs.tail, arcs.head, arcs.leg)}
    assert back.start[-1] == len(legs) == len(back.head)
    for r in range(len(width)):
        for k in range(back.start[r], back.start[r + 1]):
            value, in_q, in_r = legs.pop((back.head[k], r))
            q = back.head[k]
            assert back.leg[k] == pytest.approx([value + in_q * width[q] + in_r * width[r], -in_r, -in_q])
    assert not legs
