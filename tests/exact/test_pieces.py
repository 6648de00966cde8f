"""Pieces and arcs: they hold every real route, and their planes lie below every distance flown."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mamttsp.exact.legs import least, share_before, tangent
from mamttsp.exact.pieces import all_arcs, even_cuts, finer, finer_arcs, make_pieces, select
from mamttsp.timing import earliest_times
from tests.exact.networks import pieces_at, small, timed_routes, unlike

CASES = [(kind, seed, width) for kind in (small, unlike) for seed in range(4) for width in (50.0, 9.0)]
every_case = pytest.mark.parametrize("kind, seed, width", CASES)


def _pieces(graph, width):
    return make_pieces(graph, *even_cuts(graph, graph.V_seg, width), range(graph.n_targets))


@given(st.integers(0, 10**6))
def test_a_tangent_is_below_the_distance_and_touches_it(seed):
    rng = np.random.default_rng(seed)
    p, vq, vr = rng.choice([0.0, 1e-3, 1.0, 1e3]) * rng.normal(size=2), *rng.normal(size=(2, 2))
    d, in_q, in_r = tangent(*p, *vq, *vr)
    assert d == pytest.approx(np.hypot(*p))
    for q, r in rng.uniform(-50, 50, (100, 2)):
        assert d + in_q * q + in_r * r <= np.hypot(*(p + r * vr - q * vq)) * (1 + 1e-12) + 1e-9


@given(st.floats(-20, 20), st.floats(0, 20), st.floats(-20, 20), st.floats(-20, 20), st.floats(-30, 50))
def test_the_least_of_a_line_from_a_moment_on(start, width, left, right, time):
    share = share_before(time, start, width)
    assert share == pytest.approx((max(time, start) - start) / width if width else 0.0)
    if share <= 1.0:
        late = np.linspace(share, 1.0, 50)
        assert least(left, right, share) == pytest.approx((left + (right - left) * late).min(), abs=1e-9)


@every_case
def test_pieces_cut_the_segments_and_move_with_them(kind, seed, width):
    graph = kind(seed)
    pieces = _pieces(graph, width)
    for i in graph.V_seg:
        own = np.flatnonzero(pieces.segment == i)
        assert pieces.a[own[0]] == graph.t_lo[i] and pieces.b[own[-1]] == graph.t_hi[i]
        assert (pieces.b[own[:-1]] == pieces.a[own[1:]]).all()
        assert (pieces.b[own] - pieces.a[own] <= width * (1 + 1e-9)).all()
        assert (pieces.target[own] == graph.tau[i]).all() and (pieces.layer[own] == graph.layer[i]).all()
        for q in own:
            assert pieces.p[q] == pytest.approx(graph.position(i, pieces.a[q])) and (pieces.v[q] == graph.v[i]).all()


@every_case
def test_from_the_depot_and_to_the_end_lines_are_below_distances(kind, seed, width):
    graph = kind(seed)
    pieces = _pieces(graph, width)
    for q, i in enumerate(pieces.segment):
        k = pieces.layer[q]
        for share in np.linspace(0, 1, 20):
            time = pieces.a[q] + share * (pieces.b[q] - pieces.a[q])
            place = graph.position(i, time)
            for line, stop in ((pieces.first, graph.starts[k]), (pieces.last, graph.ends[k])):
                if math.isfinite(line[q, 0]):
                    below = line[q, 0] + share * (line[q, 1] - line[q, 0])
                    assert below <= np.hypot(*(place - graph.p_lo[stop])) + 1e-9


@every_case
def test_a_piece_is_ready_when_an_agent_can_first_be_there(kind, seed, width):
    """Home is checked here as well: a piece that can be reached and left in time is one visit that can be flown."""
    graph = kind(seed)
    pieces = _pieces(graph, width)
    for i in graph.V_seg:
        own = np.flatnonzero(pieces.segment == i)
        k, times = graph.layer[i], earliest_times(graph, [i])
        light = graph.demands[graph.tau[i]] <= graph.room[k]
        both = own[np.isfinite(pieces.ready[own]) & np.isfinite(pieces.last[own, 0])]
        assert (len(both) > 0) == (times is not None and light)
        if len(both):
            assert pieces.ready[both].min() == pytest.approx(times[0])


@every_case
def test_arcs_hold_every_real_route_and_no_flight_is_below_its_plane(kind, seed, width):
    rng, graph = np.random.default_rng(seed), kind(seed)
    pieces = _pieces(graph, width)
    arcs, checked = all_arcs(pieces), 0
    plane = {(q, r): leg for q, r, leg in zip(arcs.tail.tolist(), arcs.head.tolist(), arcs.leg)}
    for route, times, legs in timed_routes(graph, rng):
        for k, (i, j) in enumerate(itertools.pairwise(route)):
            for q, r in itertools.product(pieces_at(pieces, i, times[k]), pieces_at(pieces, j, times[k + 1])):
                c, in_q, in_r = plane[q, r]
                below = c + in_q * (times[k] - pieces.a[q]) + in_r * (times[k + 1] - pieces.a[r])
                assert below <= legs[k + 1] + 1e-7
                checked += 1
    assert checked > 50


@every_case
def test_between_parts_of_pieces_there_are_the_arcs_of_all_such_pairs(kind, seed, width):
    rng, graph = np.random.default_rng(seed), kind(seed)
    pieces = _pieces(graph, width)
    arcs = all_arcs(pieces)
    arcs = select(arcs, rng.random(len(arcs.head)) < 0.7)
    segment, a, b, origin = finer(pieces, width / 3, {int(pieces.segment[0]): pieces.a[0] + 1.0})
    parts = make_pieces(graph, segment, a, b, range(graph.n_targets))
    found, every = finer_arcs(parts, origin, arcs), all_arcs(parts)
    old = set(zip(arcs.tail.tolist(), arcs.head.tolist()))
    expected = [
        (q, r) for q, r in zip(every.tail.tolist(), every.head.tolist()) if (origin[q], origin[r]) in old
    ]  # fmt: skip
    assert sorted(zip(found.tail.tolist(), found.head.tolist())) == expected and expected
    assert (np.diff(found.tail) >= 0).all() and (found.start[found.tail] <= np.arange(len(found.tail))).all()


@every_case
def test_parts_cut_their_pieces_with_a_moment_in_the_middle_of_one(kind, seed, width):
    graph = kind(seed)
    pieces = _pieces(graph, width)
    q = int(np.argmax(pieces.b - pieces.a))
    moment = 0.6 * pieces.a[q] + 0.4 * pieces.b[q]
    _, a, b, origin = finer(pieces, 2.0, {int(pieces.segment[q]): moment})
    for piece in range(len(pieces.a)):
        own = origin == piece
        assert a[own][0] == pieces.a[piece] and b[own][-1] == pieces.b[piece] and (a[own][1:] == b[own][:-1]).all()
    around = (a <= moment) & (moment <= b) & (origin == q)
    assert (a[around] + b[around]) / 2 == pytest.approx([moment])
