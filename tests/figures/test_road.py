"""The road of a certificate: the bound only rises, the objective only falls, and they meet at the optimum."""

import matplotlib.pyplot as plt
import numpy as np

from mamttsp.figures import COLOURS, road_view


def test_bound_and_objective_meet():
    ax = road_view()
    (objective, bound) = (line.get_ydata() for line in ax.lines if not line.get_label().startswith("_"))
    (optimum,) = {line.get_ydata()[0] for line in ax.lines if line.get_linestyle() == ":"}
    assert (np.diff(bound) >= 0).all() and (np.diff(objective) <= 0).all()
    assert bound[-1] == objective[-1] == optimum
    assert [line.get_color() for line in ax.lines[1:3]] == [COLOURS[1], COLOURS[0]]
    plt.close("all")


def test_steps_name_their_sections():
    names = [f"section {k}" for k in "ABCDE"]
    texts = [text.get_text() for text in road_view(names).texts]
    assert [sum(text.endswith(name) for text in texts) for name in names] == [1] * 5
    plt.close("all")
