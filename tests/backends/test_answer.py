"""What back ends give."""

import pytest

from mamttsp.backends import Answer
from mamttsp.backends.answer import licence_trouble


def test_an_answer_has_a_known_status():
    with pytest.raises(ValueError, match="status 'fine'"):
        Answer("fine", None, None, None, None, 0.0, "script 1")


def test_licence_trouble_is_one_line():
    trouble = licence_trouble("acme", RuntimeError("No licence found\n  searched here\n  and there\n"))
    assert str(trouble) == "solver: acme cannot solve this model with the licence at hand: No licence found"
