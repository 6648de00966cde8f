"""From runs to what they say: runs into rows (`campaigns`), rows into numbers (`summaries`), the paper's claims held
against them (`claims`), and the tables and figures in files that come of it (`build_tables`, `build_figures`).

`paper_results/README.md` explains every column.
"""

from .campaigns.campaign import campaign
from .campaigns.rows import read_rows, summary, tours_of
from .campaigns.runs import PROFILES, Run, profile

__all__ = ["PROFILES", "Run", "campaign", "profile", "read_rows", "summary", "tours_of"]
