"""Compiling is not solving: the exact method is compiled before a solve's clock starts, once on a machine.

A mark beside the compiled code says that it is there, for these sources, this numba, Python and processor. Any other of
them needs its own.
"""

import hashlib
import sys
from pathlib import Path

#: s that compiling takes, on one core of 2020
_ABOUT = 30
#: instances that need nearly all of the code, with one agent and two; and parameters that need the rest, rounds with
#: shorter pieces before all labels fit
_N_TARGETS, _TOTAL_WINDOW, _AGENTS = 11, 40, (1, 2)
_SHORTER = {"enumeration": 0.01, "pieces_each": 2, "worthwhile": 2.0}


def ensure_compiled(stream=None):
    """Compile the exact method if this machine has not yet done so, and say so in a line on `stream` (stderr)."""
    mark = _mark()
    if mark is None or mark.exists():
        return
    line = f"compiling the exact solver, once on this machine: about {_ABOUT} s"
    print(line, file=sys.stderr if stream is None else stream, flush=True)
    warm_up()


def warm_up():
    """Solve small instances that use all compiled code, so that it is there and later solves do not wait for it."""
    from .exact import Parameters, solve_exact
    from .generate import generate
    from .options import Options

    for n_agents in _AGENTS:
        solve_exact(generate(_N_TARGETS, _TOTAL_WINDOW, n_agents), Options())
        solve_exact(generate(4, _TOTAL_WINDOW, n_agents), Options(), Parameters(**_SHORTER))
    if (mark := _mark()) is not None:
        mark.touch()


def _mark():
    """Return the path of the mark, in the folder in which numba keeps compiled code; None if numba does not compile."""
    import llvmlite.binding as llvm
    import numba

    from . import exact, motion

    if not hasattr(motion.earliest_meeting, "stats"):  # NUMBA_DISABLE_JIT
        return None
    folder = Path(exact.__file__).parent
    features = sorted(name for name, there in llvm.get_host_cpu_features().items() if there)
    key = hashlib.sha256(repr((sys.version, numba.__version__, llvm.get_host_cpu_name(), features)).encode())
    for source in (Path(motion.__file__), *sorted(folder.rglob("*.py"))):
        key.update(source.read_bytes())
    return Path(motion.earliest_meeting.stats.cache_path) / f"exact-{key.hexdigest()[:16]}.compiled"
