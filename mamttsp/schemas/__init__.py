"""JSON Schemas of the files: what other programs may check a file against before they hand it over.

A schema knows the fields and their kinds. That times increase, windows are inside paths and targets are slower than
agents is for `Instance.read` to say, in a line that names the field.
"""

import json
from importlib import resources

from ..validation import InputError, brief

KINDS = ("instance", "solution")


def schema(kind: str) -> dict:
    """Return the JSON Schema (draft 2020-12) of "instance" or "solution" files; InputError for another kind.

    >>> from mamttsp.schemas import schema
    >>> schema("solution")["title"]
    'mamttsp solution'
    """
    if kind not in KINDS:
        raise InputError(f"kind: expected {' or '.join(KINDS)}, found {brief(kind)}")
    return json.loads(resources.files(__name__).joinpath(f"{kind}.schema.json").read_text(encoding="utf-8"))
