"""JSON Schemas of the files: what other programs may check a file against before they hand it over.

A schema knows the fields and their kinds. That times increase, windows are inside paths and targets are slower than
agents is for `Instance.read` to say, in a line that names the field.
"""

import json
from importlib import resources


def schema(kind: str) -> dict:
    """Return the JSON Schema (draft 2020-12) of "instance" or "solution" files.

    >>> from mamttsp.schemas import schema
    >>> schema("solution")["title"]
    'mamttsp solution'
    """
    return json.loads(resources.files(__name__).joinpath(f"{kind}.schema.json").read_text(encoding="utf-8"))
