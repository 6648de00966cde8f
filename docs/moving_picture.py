"""The moving picture of the first page: the best tours known of one of the paper's random instances."""

import io

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from PIL import Image

from mamttsp import paper_instance
from mamttsp.experiments import tours_of
from mamttsp.figures import moment_view

#: three agents that all fly, which is rare: often two are best
SETTING = {"n": 10, "index": 15, "total_window": 40, "agents": 3}


def tours(results):
    """Return (instance, tours) of the setting, from best_known.csv in the folder `results`."""
    rows = pd.read_csv(results / "best_known.csv")
    row = rows[(rows[list(SETTING)] == pd.Series(SETTING)).all(axis=1)].iloc[0]
    return paper_instance(*SETTING.values()), tours_of(row)


def save(path, results, step=2.0):
    """Write the picture as a GIF: moments `step` seconds apart, and two seconds of rest at the end."""
    instance, flown = tours(results)
    last = max(tour.return_time for tour in flown)
    ax = plt.figure(figsize=(5.4, 5.2), dpi=80, layout="constrained").add_subplot()
    pictures = []
    for time in step * np.arange(np.ceil(last / step) + 1):
        ax.clear()
        moment_view(instance, flown, time, ax)
        page = io.BytesIO()
        ax.figure.savefig(page, format="png")
        pictures.append(Image.open(page).convert("RGB").quantize(64, dither=Image.Dither.NONE))
    plt.close(ax.figure)
    rests = [110] * (len(pictures) - 1) + [2000]  # ms
    pictures[0].save(path, save_all=True, append_images=pictures[1:], duration=rests, loop=0, optimize=True)
