"""Sets as bits of words against Python's own sets."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mamttsp.exact import sets

#: one word, just one and just two, three
SIZES = (1, 5, 63, 64, 65, 128, 150)


@st.composite
def two_sets(draw):
    """Return (n, X, Y): X and Y sets of some of n targets, often with some of both, or one in the other."""
    n = draw(st.sampled_from(SIZES))
    some = st.sets(st.integers(0, n - 1), max_size=8)
    x, y = draw(some), draw(some)
    return n, x, y | x if draw(st.booleans()) else y


def _words(some, n):
    """Return Python's sets of targets as words."""
    return sets.to_words(np.array([[u in x for u in range(n)] for x in some]))


def _members(bits, n):
    """Return the targets of each set, in order."""
    return [np.flatnonzero(marks).tolist() for marks in sets.to_marks(bits, n)]


@pytest.mark.parametrize("n", SIZES)
def test_a_word_holds_64_targets(n):
    bits = _words([()], n)
    assert bits.shape == (1, max(1, -(-n // 64))) and bits.dtype == np.uint64


@settings(max_examples=100)
@given(two_sets())
def test_words_are_the_sets_that_they_are_made_of(drawn):
    n, *both = drawn
    bits = _words(both, n)
    assert _members(bits, n) == [sorted(x) for x in both] and sets.to_marks(bits, n).shape == (2, n)
    assert [{u for u in range(n) if sets.has(bits, k, u)} for k in (0, 1)] == both


@settings(max_examples=100)
@given(two_sets())
def test_relations_are_those_of_sets(drawn):
    n, x, y = drawn
    one, other = _words([(), x], n), _words([y], n)
    assert sets.same(one, 1, other, 0) == (x == y)
    assert sets.subset(one, 1, other, 0) == (x <= y)
    assert sets.disjoint(one, 1, other, 0) == x.isdisjoint(y)


@settings(max_examples=100)
@given(two_sets(), st.data())
def test_a_target_is_added_to_its_set_alone(drawn, data):
    n, x, y = drawn
    u = data.draw(st.integers(0, n - 1))
    bits = _words([x, y], n)
    sets.add(bits, 0, u)
    assert _members(bits, n) == [sorted(x | {u}), sorted(y)]


@pytest.mark.parametrize("n", SIZES)
def test_arrays_with_more_room_begin_with_what_they_held(n):
    rng, used, more = np.random.default_rng(n), 7, 30
    memory = _words([rng.choice(n, min(n, 3), replace=False) for _ in range(10)], n)
    parity = rng.integers(0, 2**63, 10).astype(np.uint64)
    before = memory, parity, *rng.random((3, 10))
    after = sets.grown(*before, used, more)
    assert all(len(new) >= used + more and (new[:used] == old[:used]).all() for old, new in zip(before, after))
