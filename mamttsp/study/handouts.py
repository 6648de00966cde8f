"""Exercise sheets to hand out: `python -m mamttsp.study.handouts FOLDER`, or `make handouts`.

The sheets lose their solutions and outputs. They lie in the folder as in the repository, with the notebooks and files
that they name beside them, so every link leads somewhere wherever the folder is taken.
"""

import json
import re
import shutil
import sys
from pathlib import Path

from .course import notebooks

_ROOT = Path(__file__).parents[2]
_LINKED = re.compile(r"\]\(([^)#\s]+)[^)]*\)")
_READ = re.compile(r"[\"'](\.\./[\w./-]+\.\w+)[\"']")  # files that code opens


def hand_out(folder, root=_ROOT):
    """Write the sheets of the repository at `root`, and all that they name, into a new folder; return its path.

    FileExistsError if there is such a folder.
    """
    folder, root = Path(folder), Path(root).resolve()
    folder.mkdir(parents=True)
    sheets = notebooks(root / "notebooks" / "exercises")
    texts = {path: json.dumps(blank(json.loads(path.read_text("utf-8"))), indent=1) + "\n" for path in sheets}
    found, todo = set(sheets), list(sheets)
    while todo:
        path = todo.pop()
        for other in named_files(path, texts.get(path)) - found:
            if other.is_relative_to(root):
                found.add(other)
                todo.append(other)
    for path in found:
        copy = folder / path.relative_to(root)
        copy.parent.mkdir(parents=True, exist_ok=True)
        if path in texts:
            copy.write_text(texts[path], encoding="utf-8")
        else:
            shutil.copy2(path, copy)
    return folder


def blank(sheet):
    """Return a sheet, the JSON of a notebook, without what is tagged `solution` and without outputs."""
    cells = [dict(cell) for cell in sheet["cells"] if "solution" not in cell["metadata"].get("tags", [])]
    for cell in cells:
        if cell["cell_type"] == "code":
            cell |= {"outputs": [], "execution_count": None}
    return sheet | {"cells": cells}


def named_files(path, text=None):
    """Return the files that a notebook or a page links to, and those that a notebook's code opens.

    text: the file's content if it is not the one on the disk.
    """
    if path.suffix not in (".ipynb", ".md"):
        return set()
    text = text or path.read_text(encoding="utf-8")
    if path.suffix == ".md":
        names = _LINKED.findall(text)
    else:
        cells = json.loads(text)["cells"]
        names = [
            name
            for cell in cells
            for name in (_LINKED if cell["cell_type"] == "markdown" else _READ).findall("".join(cell["source"]))
        ]
    files = ((path.parent / name).resolve() for name in names if "://" not in name)
    return {file for file in files if file.is_file()}


if __name__ == "__main__":
    hand_out(sys.argv[1])
