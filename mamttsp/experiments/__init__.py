"""Campaigns: many runs, each in a process of its own, each a row of one CSV file that can be resumed at any time.

`paper_results/README.md` explains every column.
"""

from .campaign import campaign
from .rows import read_rows, summary, tours_of
from .runs import PROFILES, Run, profile

__all__ = ["PROFILES", "Run", "campaign", "profile", "read_rows", "summary", "tours_of"]
