"""What the paper's claims measure, at one setting or between two: each returns Parts to be judged.

bars: {(total_window, agents, n, method): Bar}, published ones or ours; settings: list of (total_window, agents, n).
"""

import math

from .bars import LIMIT
from .verdicts import Part

_UNITS = {"runtime": "s", "gap": "points"}
_NO_ROWS = "no rows"
_LEAST_RISE = 0.01  # s


def speed_up(bars, settings):
    """Run time of the baseline over that of the MICP."""
    return [_pair(bars, setting, "runtime", _ratio, "times") for setting in settings]


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
    """- % gap of the MICP with the paper's limit."""
    return [_single(bars, (*setting, "micp"), _no_gap) for setting in settings]


def mean_gap_left(bars, settings):
    """% gap of the baseline with the paper's limit, in the mean of all settings."""
    found = [bars.get((*setting, "baseline")) for setting in settings]
    label = f"mean of {len(settings)} settings"
    if None in found:
        return [Part(label, None, _NO_ROWS)]
    low, high = (sum(bar.gap[end] for bar in found) / len(found) for end in (0, 1))
    words = f"{_text((low, high))} %{_stopped_at(found)}"
    return [Part(label, (0.0 if any(bar.cut_short for bar in found) else low, high), words)]


def share_of_limit(bars, settings):
    """Mean run time of the baseline over the paper's limit."""
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
    """Of three settings: the rise of the run time from the second to the third over that from the first to the second.

    A first rise of less than 0.01 s, or a fall, counts as 0.01 s.
    """
    found = [bars.get((*setting, method)) for setting in settings]
    label = f"{_name(settings[0])} to {_name(settings[2])}"
    if None in found:
        return [Part(label, None, _NO_ROWS)]
    first, second, third = (bar.runtime for bar in found)
    before = tuple(max(end, _LEAST_RISE) for end in _difference(second, first))
    times = _ratio(_difference(third, second), before)
    return [Part(label, times, f"{_text(times)} times ({', '.join(bar.runtime_read for bar in found)})")]


def _pair(bars, setting, quantity, combine, unit=None):
    """Return the Part of both formulations."""
    both = [bars.get((*setting, method)) for method in ("baseline", "micp")]
    if None in both:
        return Part(_name(setting), None, _NO_ROWS)
    if nothing := _tells_nothing(both, quantity):
        return Part(_name(setting), None, nothing)
    number = combine(*(getattr(bar, quantity) for bar in both))
    read = "baseline {}, MICP {}".format(*(getattr(bar, f"{quantity}_read") for bar in both))
    return Part(_name(setting), number, f"{_text(number)} {unit or _UNITS[quantity]} ({read})")


def _both(bars, setting, choose):
    """Return the Part of the quantity that `choose` takes of run time and % gap."""
    parts = [_pair(bars, setting, quantity, _difference) for quantity in _UNITS]
    return choose((part for part in parts if part.number), key=lambda part: part.number, default=parts[0])


def _single(bars, key, number_and_words):
    bar = bars.get(key)
    return Part(_name(key), *(number_and_words(bar) if bar else (None, _NO_ROWS)))


def _limit_share(bar):
    return tuple(value / LIMIT for value in bar.runtime), f"{bar.runtime_read}{_stopped_at([bar])}"


def _no_gap(bar):
    closes = 0.0 if bar.cut_short else -bar.gap[0]  # what is left when it was stopped may close later
    return (-bar.gap[1], closes), f"{bar.gap_read}{_stopped_at([bar])}"


def _stopped_at(bars):
    short = sorted({bar.limit for bar in bars if bar.cut_short})
    return f" after {' and '.join(f'{limit:g}' for limit in short)} s" if short else ""


def _rise(bars, before, after, quantity):
    both = [bars.get(key) for key in (before, after)]
    label = f"{before[-1]}, {_name(before)} to {_name(after)}"
    if None in both:
        return Part(label, None, _NO_ROWS)
    if nothing := _tells_nothing(both, quantity):
        return Part(label, None, nothing)
    words = " to ".join(getattr(bar, f"{quantity}_read") for bar in both)
    return Part(label, _difference(getattr(both[1], quantity), getattr(both[0], quantity)), words)


def _tells_nothing(both, quantity):
    """Return why two bars cannot be compared, "" if they can."""
    limits = " and ".join(f"{limit:g}" for limit in sorted({bar.limit for bar in both}))
    if quantity == "runtime" and all(bar.cut_short and bar.stopped == bar.runs for bar in both):
        return f"all runs stopped after {limits} s"
    if quantity == "gap" and all(bar.without == bar.runs for bar in both):
        return f"no tours in any run within {limits} s"
    if quantity == "gap" and both[0].limit != both[1].limit and min(both, key=lambda bar: bar.limit).cut_short:
        return f"gaps left after {limits} s"
    return ""


def _ratio(above, below):
    return above[0] / below[1], above[1] / below[0] if below[0] else math.inf


def _difference(one, other):
    return one[0] - other[1], one[1] - other[0]


def _text(number):
    low, high = (f"{end:.0f}" if 1000 <= abs(end) < math.inf else f"{end:.3g}" for end in number)
    if number[1] == math.inf:
        return f"at least {low}"
    return low if low == high else f"{low} to {high}"


def _name(key):
    window, agents, n = key[:3]
    return f"{n} targets, {window} s, {agents} agent{'s' if agents > 1 else ''}"
