"""What back ends take and give."""

import math

import pytest

from mamttsp.backends import Answer
from mamttsp.backends.answer import known_length, licence_trouble
from mamttsp.backends.clock import Clock


@pytest.mark.parametrize("unknown", [None, math.inf, -math.inf, math.nan, 1e20, -1e20])
def test_what_solvers_use_for_no_value_is_none(unknown):
    assert known_length(unknown) is None


def test_a_length_is_never_below_zero():
    assert known_length(-1e-9) == 0.0 and known_length(3) == 3.0


def test_an_answer_has_a_known_status():
    with pytest.raises(ValueError, match="status 'fine'"):
        Answer("fine", None, None, None, None, 0.0, "script 1")


def test_licence_trouble_is_one_line():
    trouble = licence_trouble("acme", RuntimeError("No licence found\n  searched here\n  and there\n"))
    assert str(trouble) == "solver: acme cannot solve this model with the licence at hand: No licence found"


def test_a_clock_counts_down_to_its_limit():
    clock = Clock(100.0)
    assert 0.0 < clock.left <= 100.0 and clock.spent >= 0.0 and not clock.over
    over = Clock(1e-9)
    assert over.spent > 0.0 and over.left == 0.0 and over.over
    assert Clock().left is None and not Clock().over
