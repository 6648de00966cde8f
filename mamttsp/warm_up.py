"""Compiling is not solving: what a method needs compiled is, before a solve's clock starts, once on a machine.

A mark beside the compiled code says that it is there, for these sources, this numba, Python and processor. Any other of
them needs its own.
"""

import hashlib
import sys
from pathlib import Path

import numpy as np

#: what is compiled apart, for the exact method and for the back end "clarabel": what people call it, s that compiling
#: takes on one core of 2020, the package in which it is
PARTS = {
    "exact": ("the exact solver", 30, "exact"),
    "clarabel": ("our branch and bound", 3, "branch_and_bound"),
}
#: instances that need nearly all of the code, with one agent and two; and parameters that need the rest, rounds with
#: shorter pieces before all labels fit
_N_TARGETS, _TOTAL_WINDOW, _AGENTS = 11, 40, (1, 2)
_SHORTER = {"enumeration": 0.01, "enumeration_alone": 0.01, "least_extensions": 0, "pieces_each": 2, "worthwhile": 2.0}


def ensure_compiled(part="exact", stream=None):
    """Compile one of PARTS if this machine has not yet done so, and say so in a line on `stream` (stderr)."""
    mark, (name, about, _) = _mark(part), PARTS[part]
    if mark is None or mark.exists():
        return
    line = f"compiling {name}, once on this machine: about {about} s"
    print(line, file=sys.stderr if stream is None else stream, flush=True)
    warm_up(part)


def warm_up(part="exact"):
    """Run all compiled code of one of PARTS on small instances, so that it is there and later solves do not wait."""
    {"exact": _solve_small_ones, "clarabel": _propagate}[part]()
    if (mark := _mark(part)) is not None:
        mark.touch()


def _solve_small_ones():
    from .exact import Parameters, solve_exact
    from .generate import generate
    from .options import Options

    for n_agents in _AGENTS:
        solve_exact(generate(_N_TARGETS, _TOTAL_WINDOW, n_agents), Options())
        solve_exact(generate(4, _TOTAL_WINDOW, n_agents), Options(), Parameters(**_SHORTER))


def _propagate():
    from .branch_and_bound.beam import beam_routes
    from .branch_and_bound.propagation import propagate
    from .graph import build_graph
    from .instance import Instance, Target

    targets = [Target.parked((1, 0), (0, 9)), Target.parked((2, 0), (0, 9))]
    graph = build_graph(Instance(targets, n_agents=1, depot=(0, 0), max_speed=1, horizon=9))
    alive = np.ones(len(graph.edges), dtype=bool)
    alive, times = propagate(graph, alive, alone=True)
    beam_routes(graph, np.zeros(len(alive)), alive, times, graph.counts)


def _mark(part):
    """Return the path of the mark, in the folder in which numba keeps compiled code; None if numba does not compile."""
    import llvmlite.binding as llvm
    import numba

    from . import motion

    if not hasattr(motion.earliest_meeting, "stats"):  # NUMBA_DISABLE_JIT
        return None
    folder = Path(__file__).parent / PARTS[part][2]
    features = sorted(name for name, there in llvm.get_host_cpu_features().items() if there)
    key = hashlib.sha256(repr((sys.version, numba.__version__, llvm.get_host_cpu_name(), features)).encode())
    for source in (Path(motion.__file__), *sorted(folder.rglob("*.py"))):
        key.update(source.read_bytes())
    return Path(motion.earliest_meeting.stats.cache_path) / f"{part}-{key.hexdigest()[:16]}.compiled"
