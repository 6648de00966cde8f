"""What the paper's claims measure, at one setting or between two: each returns Parts to be judged.

bars: {(total_window, agents, n, method): Bar}, published ones or ours; settings: list of (total_window, agents, n).
"""

import math

from .bars import LIMIT
from .verdicts import Part

_UNITS = {"runtime": "s", "gap": "%"}
_NO_ROWS = "no rows"


def speed_up(bars, settings):
    """Run time of the baseline over that of the MICP."""
    return [_pair(bars, setting, "runtime", _ratio) for setting in settings]


def seconds_saved(bars, settings):
    """Run time of the baseline less that of the MICP, in s."""
    return [_pair(bars, setting, "runtime", _difference) for setting in settings]


def gap_drop(bars, settings):
    """% gap of the baseline less that of the MICP, in points."""
    return [_pair(bars, setting, "gap", _difference) for setting in settings]


def no_worse(bars, settings):
    """What of run time (s) and % gap speaks most against the MICP: the smaller of the two differences."""
    return [_both(bars, setting, min) for setting in settings]


def better_in_one(bars, settings):
    """What of run time (s) and % gap speaks most for the MICP: the larger of the two differences."""
    return [_both(bars, setting, max) for setting in settings]


def no_gap(bars, settings):
    """- % gap of the MICP; what a limit shorter than the paper's stopped tells nothing."""
    return [_single(bars, (*setting, "micp"), _no_gap) for setting in settings]


def gap_left(bars, settings):
    """% gap of the baseline."""
    return [_single(bars, (*setting, "baseline"), _gap_left) for setting in settings]


def share_of_limit(bars, settings):
    """Mean run time of the baseline over the limit."""
    return [_single(bars, (*setting, "baseline"), _limit_share) for setting in settings]


def rises(bars, steps, methods=("micp", "baseline"), quantities=("runtime", "gap")):
    """How much run time (s) and % gap rise over each step, a pair of settings."""
    return [
        _rise(bars, (*before, method), (*after, method), quantity)
        for before, after in steps
        for method in methods
        for quantity in quantities
    ]


def later_rise(bars, settings, method="micp"):
    """Of three settings: how much more the run time (s) rises from the second on than it did before."""
    found = [bars.get((*setting, method)) for setting in settings]
    label = f"{_name(settings[0])} to {_name(settings[2])}"
    if None in found:
        return [Part(label, None, _NO_ROWS)]
    words = ", ".join(f"{bar.runtime_read} s" for bar in found)
    if found[1].stopped:
        return [Part(label, None, f"{words}, the second cut short by the limit")]
    a, b, c = (bar.runtime for bar in found)
    return [Part(label, (c[0] - 2 * b[1] + a[0], c[1] - 2 * b[0] + a[1]), words)]


def _pair(bars, setting, quantity, combine):
    """Return the Part of both formulations."""
    both = [bars.get((*setting, method)) for method in ("baseline", "micp")]
    if None in both:
        return Part(_name(setting), None, _NO_ROWS)
    read = "baseline {}, MICP {}".format(*(_read(bar, quantity) for bar in both))
    if nothing := _tells_nothing(both, quantity):
        return Part(_name(setting), None, nothing)
    number = combine(*(getattr(bar, quantity) for bar in both))
    return Part(_name(setting), number, f"{_text(number)} ({read})")


def _both(bars, setting, choose):
    """Return the Part of the quantity that `choose` takes of run time and % gap."""
    parts = [_pair(bars, setting, quantity, _difference) for quantity in _UNITS]
    return choose((part for part in parts if part.number), key=lambda part: part.number, default=parts[0])


def _single(bars, key, number_and_words):
    bar = bars.get(key)
    return Part(_name(key), *(number_and_words(bar) if bar else (None, _NO_ROWS)))


def _limit_share(bar):
    return tuple(value / bar.limit for value in bar.runtime), f"{bar.runtime_read} s of {bar.limit:g} s"


def _gap_left(bar):
    return bar.gap, _read(bar, "gap")


def _no_gap(bar):
    if bar.stopped and bar.limit < LIMIT:
        optimal = "" if bar.optimal is None else f", optimal tours found in {bar.optimal} of {bar.runs} runs"
        return None, f"{_read(bar, 'gap')} left after {bar.limit:g} s{optimal}"
    return (-bar.gap[1], -bar.gap[0]), _read(bar, "gap")


def _rise(bars, before, after, quantity):
    label, both = f"{_name(before)} to {_name(after)}", [bars.get(key) for key in (before, after)]
    label = f"{before[-1]}, {label}"
    if None in both:
        return Part(label, None, _NO_ROWS)
    words = " to ".join(_read(bar, quantity) for bar in both)
    if nothing := _tells_nothing(both, quantity):
        return Part(label, None, nothing)
    return Part(label, _difference(getattr(both[1], quantity), getattr(both[0], quantity)), words)


def _tells_nothing(both, quantity):
    """Return why two bars cannot be compared, "" if they can: the limit stopped every run, or none found tours."""
    if quantity == "runtime" and all(bar.stopped == 1.0 for bar in both):
        return f"both at the limit of {both[0].limit:g} s"
    if quantity == "gap" and all(bar.gap == (100.0, 100.0) for bar in both):
        return "both at 100 %, without tours"
    return ""


def _ratio(above, below):
    return above[0] / below[1], above[1] / below[0] if below[0] else math.inf


def _difference(one, other):
    return one[0] - other[1], one[1] - other[0]


def _text(number):
    low, high = (f"{end:.3g}" for end in number)
    if number[1] == math.inf:
        return f"at least {low}"
    return low if low == high else f"{low} to {high}"


def _read(bar, quantity):
    return f"{getattr(bar, quantity + '_read')} {_UNITS[quantity]}"


def _name(key):
    window, agents, n = key[:3]
    return f"{n} targets, {window} s, {agents} agent{'s' if agents > 1 else ''}"
