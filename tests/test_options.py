"""The clock that all methods share."""

from mamttsp.options import Clock


def test_a_clock_counts_down_to_its_limit():
    clock = Clock(100.0)
    assert 0.0 < clock.left <= 100.0 and clock.spent >= 0.0 and not clock.over
    over = Clock(1e-9)
    assert over.spent > 0.0 and over.left == 0.0 and over.over
    assert Clock().left is None and not Clock().over
