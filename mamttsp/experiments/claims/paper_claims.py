"""The paper's quantitative claims about its Figures 2 and 3, in our words: where each stands, and how it is tested.

How they are read: an improvement of the % gap is in points; k orders of magnitude is a factor nearer to 10^k than to
10^(k-1) on a logarithmic axis; round numbers may be rounded; a run that is stopped counts at its limit, as theirs do.
"""

import itertools
import math
from typing import NamedTuple

from ...generate import PAPER_SIZES
from ..campaigns.runs import SETTINGS
from . import measures
from .verdicts import judge, judge_best

_ONE_ORDER, _TWO_ORDERS = 10**0.5, 10**1.5
#: less than this, in s or points, is a tie; % gap that counts as none: the solvers' own limit
_TIE, _CLOSED = 0.05, 0.01


class Claim(NamedTuple):
    """section: where the paper says it; text: what it says; find: from bars (see bars.py) to a Finding."""

    section: str
    text: str
    find: object


def _at(settings, *sizes):
    """Return (total_window, agents, n) for all sizes and settings."""
    return [(*setting, n) for n in sizes for setting in settings]


def _more_targets(settings):
    return [step for setting in settings for step in itertools.pairwise(_at([setting], *PAPER_SIZES))]


def _next_setting(settings, *sizes):
    return [step for n in sizes for step in itertools.pairwise(_at(settings, n))]


def _all(measure, where, least, direction=0.0, most=math.inf, **options):
    return lambda bars: judge(getattr(measures, measure)(bars, where, **options), least, direction, most)


def _up_to(measure, where, least, direction=0.0):
    return lambda bars: judge_best(getattr(measures, measure)(bars, where), least, direction)


def _never_less(measure, where, **options):
    return _all(measure, where, -_TIE, -_TIE, **options)


def _closed(where):
    return _all("no_gap", where, -_CLOSED, -_CLOSED)


def _faster(where, factor):
    return _all("speed_up", where, factor, 1.0)


_WINDOWS = [(20, 1), (40, 1), (60, 1)]
_AGENTS = [(40, m) for m in (2, 3, 4, 5)]
_HARD = [(60, 1, 15), (40, 1, 20), (60, 1, 20)]
_LIMITED = _at(_AGENTS, 15) + _at([(40, 4), (40, 5)], 10)
_ONE_TO_FIVE = [(40, 1), *_AGENTS]
_EVERYWHERE = _at(SETTINGS, *PAPER_SIZES)
_BASELINE, _MICP_TIMES = {"methods": ("baseline",)}, {"methods": ("micp",), "quantities": ("runtime",)}

_FIVE_TO_ONE = [((40, 5, n), (40, 1, n)) for n in (15, 20)]

_WHOLE = (
    ("Abstract, I", "up to two orders of magnitude less run time", _up_to("speed_up", _EVERYWHERE, _TWO_ORDERS, 1.0)),
    ("Abstract, I", "up to 90 points less % gap, and more", _up_to("gap_drop", _EVERYWHERE, 90)),
)
_BY_WINDOW = (
    ("V-B", "one agent: more targets take more time and leave more gap", _never_less("rises", _more_targets(_WINDOWS))),
    (
        "V-B",
        "one agent: longer windows take more time and leave more gap",
        _never_less("rises", _next_setting(_WINDOWS, *PAPER_SIZES)),
    ),
    ("V-B, Fig. 2", "one agent: MICP is nowhere the worse one", _never_less("no_worse", _at(_WINDOWS, *PAPER_SIZES))),
    ("Fig. 2", "10 targets, 60 s: MICP is two orders of magnitude faster", _faster([(60, 1, 10)], _TWO_ORDERS)),
    ("Fig. 2", "15 targets, 40 s: MICP is two orders of magnitude faster", _faster([(40, 1, 15)], _TWO_ORDERS)),
    ("Fig. 2", "15 targets, 40 s: MICP leaves over 15 points less % gap", _all("gap_drop", [(40, 1, 15)], 15)),
    ("Fig. 2", "15 at 60 s, 20 at 40 and 60 s: up to about 1000 s faster", _up_to("seconds_saved", _HARD, 950)),
    ("Fig. 2", "there MICP leaves 35 to 40 points less % gap", _all("gap_drop", _HARD, 34.5, most=40.5)),
    ("V-B", "15 targets, one agent: MICP always closes the gap", _closed(_at(_WINDOWS, 15))),
    ("V-B", "15 targets: MICP's run time jumps at 60 s only", _all("later_rise", _at(_WINDOWS, 15), 0)),
    (
        "V-B",
        "15 targets: the baseline worsens with windows",
        _all("rises", _next_setting(_WINDOWS, 15), _TIE, **_BASELINE),
    ),
    ("V-B", "20 targets: MICP has less run time or less gap", _all("better_in_one", _at(_WINDOWS, 20), _TIE)),
)
_BY_AGENTS = (
    (
        "V-C",
        "2 to 5 agents: more targets take more time and leave more gap",
        _never_less("rises", _more_targets(_AGENTS)),
    ),
    (
        "V-C",
        "more agents worsen the baseline",
        _never_less("rises", _next_setting(_ONE_TO_FIVE, 10, 15, 20), **_BASELINE),
    ),
    ("V-C", "MICP is faster with 5 agents than with one", _all("rises", _FIVE_TO_ONE, _TIE, _TIE, **_MICP_TIMES)),
    (
        "V-C, Fig. 3",
        "2 to 5 agents: MICP is nowhere the worse one",
        _never_less("no_worse", _at(_AGENTS, *PAPER_SIZES)),
    ),
    (
        "V-C",
        "15 targets, 2 to 5 agents, and 10, 4 and 5: baseline at its limit",
        _all("share_of_limit", _LIMITED, 0.99, 0.5),
    ),
    ("V-C", "there over 60 % gap is left", _all("gap_left", _LIMITED, 60)),
    ("V-C", "2 to 5 agents: MICP always closes the gap", _closed(_at(_AGENTS, *PAPER_SIZES))),
    ("V-C", "10 targets: up to two orders of magnitude faster", _up_to("speed_up", _at(_AGENTS, 10), _TWO_ORDERS, 1.0)),
    ("V-C, Fig. 3", "15 targets: two orders of magnitude faster", _faster(_at(_AGENTS, 15), _TWO_ORDERS)),
    ("V-C, Fig. 3", "20 targets: one order of magnitude faster", _faster(_at(_AGENTS, 20), _ONE_ORDER)),
    ("Fig. 3", "15 targets, 2 agents: over 50 points less % gap", _all("gap_drop", [(40, 2, 15)], 50)),
    ("Fig. 3", "15 targets, 5 agents: over 90 points less % gap", _all("gap_drop", [(40, 5, 15)], 90)),
    ("Fig. 3", "20 targets, 2 agents: 60 points less % gap", _all("gap_drop", [(40, 2, 20)], 60)),
    ("Fig. 3", "20 targets, 5 agents: over 90 points less % gap", _all("gap_drop", [(40, 5, 20)], 90)),
)
CLAIMS = tuple(Claim(*claim) for claim in _WHOLE + _BY_WINDOW + _BY_AGENTS)
