"""The process of one run: a Run or a LibraryRun and the campaign's process id in, its answer out, both JSON."""

import ctypes
import json
import os
import signal
import sys
import time
from importlib import metadata

from ...formulations.statistics import closed_form
from ...generate import generate
from ...graph import build_graph
from ...solve import solve
from ...warm_up import warm_up
from .runs import run_of

GAP, THREADS, SEED = 1e-4, 1, 0


def main():
    """Answer one run. What a solver prints goes to standard error, and an exception is an answer too."""
    given = json.load(sys.stdin)
    _die_with(given.pop("campaign"))
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "w")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    run = run_of(given)
    try:
        answer = measure(run)
    except Exception as error:
        answer = {"status": "error", "message": f"{type(error).__name__}: {error}"}
    with answers:
        json.dump(answer, answers)


def measure(run):
    """Solve a run and return its answer, the sizes of its model and its tours as fields of a row."""
    _warm_up(run)
    instance = run.instance()
    start = time.perf_counter()
    options = {"time_limit": run.time_limit, "gap": GAP, "threads": THREADS, "seed": SEED}
    solution = solve(instance, run.method, run.modeler, run.solver, **options)
    solve_time = time.perf_counter() - start
    return {
        "status": solution.status,
        "objective": solution.objective,
        "bound": solution.bound,
        "gap": solution.gap,
        "gap_percent": None if solution.gap is None else 100 * solution.gap,
        "runtime_s": round(solution.runtime, 4),
        "build_time_s": round(solution.build_time, 4),
        "solve_time_s": round(solve_time, 4),
        "nodes": solution.nodes,
        "subtour_cuts": solution.subtour_cuts,
        "tours": json.dumps([tour.to_dict() for tour in solution.tours], separators=(",", ":")),
        "solver_version": solution.solver,
        "modeler_version": run.modeler and f"{run.modeler} {metadata.version(run.modeler)}",
        "gap_limit": GAP,
        "threads": THREADS,
        "seed": SEED,
    } | _sizes(run, instance)


def _warm_up(run):
    """Import and compile all that the run needs, so that its times are those of the solve alone."""
    if run.method == "exact":
        warm_up()
    else:
        solve(generate(3, 20), run.method, run.modeler, run.solver, time_limit=run.time_limit)


def _sizes(run, instance):
    """Return the graph's and the model's sizes, as columns; the graph is the paper's, of agents that are alike."""
    if not instance.plain:
        return {}
    graph = build_graph(instance)
    sizes = {"V": graph.s_prime + 1, "E": len(graph.edges)}
    if run.method == "exact":
        return sizes
    return sizes | closed_form(run.method, run.n, run.agents, **sizes)._asdict()


def _die_with(campaign):
    """A campaign that is killed takes its runs with it on Linux; elsewhere they end at their time limit."""
    if sys.platform == "linux":
        set_parent_death_signal = 1
        ctypes.CDLL(None).prctl(set_parent_death_signal, signal.SIGKILL)
    if os.getppid() != campaign:  # it was killed before this process came so far
        sys.exit("the campaign is gone")


if __name__ == "__main__":
    main()
