"""The benchmark of constants: every constant that a search weighs is varied, and a row is a ratio of times."""

import dataclasses

from benchmarks import constants as benchmark
from mamttsp import generate
from mamttsp.exact import Parameters

#: limits of memory, time and accuracy, which are not weighed
LIMITS = {"annealing_step", "annealing_longest", "choice_seconds", "most_labels", "most_pieces", "most_arcs"}
LIMITS |= {"annealing_most", "most_entries", "most_labels_alone", "arcs_rate", "hardly", "thinnest", "left_out"}


def test_every_constant_is_varied_or_a_limit():
    assert set(benchmark.VARIED) | LIMITS == {field.name for field in dataclasses.fields(Parameters)}
    assert not set(benchmark.VARIED) & LIMITS
    for name, values in benchmark.VARIED.items():
        assert getattr(Parameters(), name) not in values and len(set(values)) == len(values) >= 2


def test_a_row_is_the_ratio_to_the_default(monkeypatch):
    small = {"one": generate(4, 40, 1), "two": generate(4, 40, 2)}
    monkeypatch.setattr(benchmark, "seconds", lambda instance, **changed: 2.0 * instance.n_agents)
    row = benchmark.measure("columns", 15, {"one": 1.0, "two": 1.0}, small)
    assert (row["constant"], row["value"], row["default"]) == ("columns", "15", "30")
    assert abs(row["ratio"] - 8**0.5) < 1e-12 and (row["least"], row["most"], row["stopped"]) == (2.0, 4.0, 0)
