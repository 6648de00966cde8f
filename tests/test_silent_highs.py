"""HiGHS says nothing unless it is asked to, whatever its version prints when it is made."""

import highspy

from mamttsp import solve
from mamttsp.silent_highs import SilentHighs
from tests.examples import instance, still

PROBLEM = instance(still(10, 0), still(0, 10))


def test_its_output_is_off_before_anything_is_done_with_it(monkeypatch):
    told = []
    monkeypatch.setattr(highspy.Highs, "enableCallbacks", lambda self: told.append(self.getOptionValue("output_flag")))
    SilentHighs()
    assert [value for _, value in told] == [False]


def test_a_solve_prints_nothing_and_a_verbose_one_the_log(capfd):
    assert solve(PROBLEM, "micp", solver="highs").status == "optimal"
    assert capfd.readouterr() == ("", "")
    solve(PROBLEM, "micp", solver="highs", verbose=True)
    assert "HiGHS" in capfd.readouterr().out
