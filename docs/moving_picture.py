"""The moving picture of the first page: the best tours known of one of our instances by the paper's recipe."""

import pandas as pd

from mamttsp import paper_instance
from mamttsp.experiments import tours_of
from mamttsp.figures import film

#: three agents that all fly, which is rare: often two are best
SETTING = {"n": 10, "index": 15, "total_window": 40, "agents": 3}


def save(path, results):
    """Write the picture as a GIF. results: the folder of best_known.csv, where the tours stand."""
    rows = pd.read_csv(results / "best_known.csv")
    row = rows[(rows[list(SETTING)] == pd.Series(SETTING)).all(axis=1)].iloc[0]
    film(paper_instance(*SETTING.values()), tours_of(row), step=2).save(path)
