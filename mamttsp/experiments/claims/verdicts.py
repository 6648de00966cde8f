"""How a claim is judged: each setting's number is held against what the claim says, then the settings are put together.

A number is an interval; what it leaves open stays open.
"""

import math
from typing import NamedTuple

HOLDS, DIRECTION, DIFFERS, OPEN = "holds", "holds in direction", "differs", "cannot be tested here"
#: of one setting only: the number points where the claim does, but may be in its interval or not
_SIZE_OPEN = "holds in direction, its size open,"
#: so many settings are told one by one; of more, only those that decide
_FEW = 4


class Part(NamedTuple):
    """One setting: its name, the number as (low, high) or None if there is none to test, and the same in words."""

    label: str
    number: tuple | None
    words: str


class Finding(NamedTuple):
    """verdict; numbers and counts: what it rests on, in words; against: a number contradicts the claim."""

    verdict: str
    numbers: str
    counts: str
    against: bool


def judge(parts, least, direction, most=math.inf):
    """Return the Finding for a claim that the number is in [least, most] at every setting.

    direction: a number above this one still points where the claim does. A claim cannot be tested if most settings
    cannot; it differs if at least half of the others do; it holds if all do; and else it holds in direction.
    """
    verdicts = [_verdict(part.number, least, direction, most) for part in parts]
    tested = [verdict for verdict in verdicts if verdict != OPEN]
    if 2 * len(tested) < len(verdicts):
        verdict = OPEN
    elif 2 * tested.count(DIFFERS) >= len(tested):
        verdict = DIFFERS
    else:
        verdict = HOLDS if set(verdicts) == {HOLDS} else DIRECTION
    against = [part for part, found in zip(parts, verdicts) if found in (DIRECTION, DIFFERS)]
    few = parts if len(parts) <= _FEW else against or sorted(parts, key=_height)
    return Finding(verdict, _words(few[:_FEW]), _counts(verdicts), bool(against))


def judge_best(parts, least, direction):
    """Return the Finding for a claim that the number is "up to" `least`: at least that at one setting."""
    verdicts = [_verdict(part.number, least, direction, math.inf) for part in parts]
    best = next(one for one in (HOLDS, DIRECTION, _SIZE_OPEN, OPEN, DIFFERS) if one in verdicts)
    verdict = DIRECTION if best == _SIZE_OPEN else best
    against = verdict in (DIRECTION, DIFFERS) and not {OPEN, _SIZE_OPEN} & set(verdicts)
    return Finding(verdict, _words([max(parts, key=_depth)]), _counts(verdicts), against)


def _verdict(number, least, direction, most):
    if number is None:
        return OPEN
    low, high = number
    if low >= least and high <= most:
        return HOLDS
    if low > direction:
        return _SIZE_OPEN if high >= least and low <= most else DIRECTION
    return DIFFERS if high <= direction else OPEN


def _depth(part):
    """Order by number, untested ones first."""
    return (-math.inf,) if part.number is None else part.number


def _height(part):
    """Order by number, untested ones last."""
    return (math.inf,) if part.number is None else part.number


def _words(parts):
    """Return the parts in words, those of the same words together."""
    labels = {}
    for part in parts:
        labels.setdefault(part.words, []).append(part.label)
    return "; ".join(f"{_together(names)}: {words}" for words, names in labels.items())


def _together(names):
    return names[0] if len(names) == 1 else f"{len(names)} settings"


def _counts(verdicts):
    found = [verdict for verdict in (HOLDS, DIRECTION, _SIZE_OPEN, DIFFERS, OPEN) if verdict in verdicts]
    parts = [f"{verdict} at {verdicts.count(verdict)}" for verdict in found]
    return f"{', '.join(parts)} of {len(verdicts)} settings".replace("at 1 of 1 settings", "at the one setting")
