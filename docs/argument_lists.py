"""Arguments as a list: docstrings say them in sentences, "n: how many; seed: of the draws", and pages one a line.

A sentence, or a part of one behind a semicolon, that begins with arguments of the function and a colon is about these,
up to the next one; what begins with an exception's name says when that is raised.
"""

import inspect
import re

_RAISED = ("InputError", "TourError", "FlowError", "SolverUnavailable")


def add(app, what, name, obj, options, lines):
    """Change the lines of a docstring in place."""
    try:
        names = list(inspect.signature(obj).parameters)
    except (TypeError, ValueError):  # nothing that can be called
        return
    lines[:] = with_list(lines, [*names, *_RAISED])


def with_list(lines, names):
    """Return the lines of a docstring, what is said of these names in a field list before the first example."""
    known = "|".join(map(re.escape, names))
    start = re.compile(rf"(?:^|(?<=[.;:] ))((?:{known})(?:, (?:{known}))*): ")
    text, fields, paragraphs = [], [], "\n".join(lines).strip("\n").split("\n\n")
    examples = next((k for k, paragraph in enumerate(paragraphs) if paragraph.startswith(">>> ")), len(paragraphs))
    for paragraph in paragraphs[:examples]:
        before, *said = start.split(" ".join(paragraph.split()))
        text.append(before.strip() if said else paragraph)
        for which, what in zip(said[::2], said[1::2]):
            sentence = what.strip().removesuffix(";").removesuffix(".") + "."
            fields += [f":{'raises' if name in _RAISED else 'param'} {name}: {sentence}" for name in which.split(", ")]
    whole = ["\n\n".join(filter(None, text)), "\n".join(fields), *paragraphs[examples:]]
    return "\n\n".join(filter(None, whole)).split("\n") + [""]
