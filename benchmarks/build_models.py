"""Measure how long each model takes to build and to hand over, and how large it is; write the table into README.md.

Run with `make benchmarks`. Build: from the graph to the model. Hand-over: from a Pyomo model to a loaded SCIP model,
and from a cvxpy problem to the conic program that every solver of it is given.
"""

import importlib.metadata
import platform
import time

from tqdm import tqdm

from benchmarks.readme import write_section
from mamttsp import build_graph, generate
from mamttsp.backends.scip_models import from_pyomo
from mamttsp.formulations import build_formulation
from mamttsp.versions import processor

SIZES, FLEETS = (5, 10, 15, 20), (1, 3, 5)
MODELS = (("micp", "pyomo"), ("micp", "cvxpy"), ("baseline", "pyomo"), ("baseline", "cvxpy"), ("nonconvex", "pyomo"))
REPEATS = 3
COLUMNS = (
    "n | m | model | modeler | build (s) | hand-over (s) | variables | binaries | linear rows | cones | bilinear rows"
)


def measure(method, modeler, graph, n_agents):
    """Return (least build time, least hand-over time, Statistics) of a model, in s, over a few repetitions."""
    build_times, hand_over_times = [], []
    for _ in range(REPEATS):
        formulation = build_formulation(method, modeler, graph, n_agents)
        start = time.perf_counter()
        if modeler == "pyomo":
            from_pyomo(formulation.model)
        else:
            formulation.conic_program()
        hand_over_times.append(time.perf_counter() - start)
        build_times.append(formulation.build_time)
    return min(build_times), min(hand_over_times), formulation.statistics()


def table():
    """Return the lines of the table, with progress on the way."""
    yield f"Instance 0 of each size, windows of 40 s in total, all edges; least of {REPEATS} runs in one process."
    yield f"Python {platform.python_version()}, {', '.join(_versions())}; {processor()}."
    yield ""
    yield f"| {COLUMNS} |"
    yield "|--:|--:|---|---" + "|--:" * 7 + "|"
    cases = [(n, m, *model) for n in SIZES for m in FLEETS for model in MODELS]
    for n, m, method, modeler in tqdm(cases, unit="model"):
        build, hand_over, size = measure(method, modeler, build_graph(generate(n, 40, m)), m)
        rows = (size.variables, size.binaries, size.linear_rows, size.cones, size.bilinear_rows)
        yield f"| {n} | {m} | {method} | {modeler} | {build:.3f} | {hand_over:.3f} | {' | '.join(map(str, rows))} |"


def _versions():
    return [f"{name} {importlib.metadata.version(name)}" for name in ("pyomo", "cvxpy", "pyscipopt")]


def main():
    write_section("build_models.py", list(table()))


if __name__ == "__main__":
    main()
