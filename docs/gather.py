"""Lays the notebooks, and the files that they link to, beside the pages, as they lie in the repository.

So a link between two files is the same there and here. The copies are made anew with each build; git ignores them.
"""

import shutil
from pathlib import Path

import moving_picture

DOCS = Path(__file__).parent
FOLDERS = ("notebooks", "figures", "paper_results")
_PASSING = shutil.ignore_patterns(".ipynb_checkpoints", "*.nbconvert.ipynb", "handouts", "__pycache__")


def gather(app):
    """Copy what the pages show, and draw the moving picture."""
    for name in FOLDERS:
        shutil.rmtree(DOCS / name, ignore_errors=True)
        shutil.copytree(DOCS.parent / name, DOCS / name, ignore=_PASSING)
    shutil.copy2(DOCS.parent / "CITATION.cff", DOCS)
    changelog = DOCS.parent / "CHANGELOG.md"
    (DOCS / changelog.name).write_text(changelog.read_text("utf-8") if changelog.exists() else "# Changelog\n", "utf-8")
    moving_picture.save(DOCS / "figures" / "tours.gif", DOCS.parent / "paper_results")
