"""The committed rows of the exact method: all settings certified, every tour flown, monotone in windows and agents."""

from pathlib import Path

import pytest

from mamttsp import check, paper_instance
from mamttsp.experiments import tours_of
from mamttsp.experiments.campaigns.rows import read_rows

ROWS = read_rows(Path(__file__).parents[3] / "paper_results" / "exact.csv")
GAP = 1e-4


def _key(row):
    return tuple(int(float(row[name])) for name in ("n", "index", "total_window", "agents"))


FOUND = {_key(row): row for row in ROWS}
LONGER = [((n, i, w, 1), (n, i, w + 20, 1)) for n, i, w, m in FOUND if m == 1 and w < 60]
MORE_AGENTS = [((n, i, 40, m), (n, i, 40, m + 1)) for n, i, w, m in FOUND if w == 40 and m < 5]


def test_all_settings_are_certified():
    assert len(ROWS) == len(FOUND) == 560
    for key, row in FOUND.items():
        assert row["status"] == "optimal" and float(row["gap"]) <= GAP, key
        assert float(row["bound"]) <= float(row["objective"]), key


@pytest.mark.parametrize("n", [5, 10, 15, 20])
def test_the_tours_of_each_row_are_as_long_as_it_says(n):
    for key, row in FOUND.items():
        if key[0] == n:
            assert check(paper_instance(*key), tours_of(row)) == pytest.approx(float(row["objective"]), rel=1e-9), key


@pytest.mark.parametrize("pairs", [LONGER, MORE_AGENTS], ids=["longer windows", "more agents"])
def test_more_freedom_never_costs(pairs):
    assert len(pairs) in (160, 320)
    for tight, free in pairs:
        least, most = (float(FOUND[key][name]) for key, name in ((free, "bound"), (tight, "objective")))
        assert least <= most * (1 + 1e-9), (tight, free)
        assert float(FOUND[free]["objective"]) <= most * (1 + GAP), (tight, free)
