"""The relaxed bounds of both conic programs on our 80 instances, as rows of a results file."""

import itertools
import time
from importlib import metadata

from tqdm import tqdm

from ...generate import PAPER_INDICES, PAPER_SIZES, paper_instance
from ...relaxation import CONIC_METHODS, relax
from .provenance import now, provenance
from .results import Results
from .rows import INSTANCE, key_of
from .runs import SETTINGS


def relaxations(path, sizes=PAPER_SIZES, indices=PAPER_INDICES, quiet=False):
    """Append a row to the results file `path` for each relaxation that has none yet, of both methods in all settings.

    sizes, indices: which of paper_instance's; quiet: no progress bar. It can be stopped at any moment and started
    again, and several at a time share the work. InputError: a file that is not ours, or that cannot be written.
    """
    about = provenance(jobs=1)
    runs = list(_runs(sizes, indices))
    with Results(path) as results:
        for key in tqdm(runs, unit="relaxation", disable=quiet):
            if results.claim(key_of(key)):
                results.append(key | _measure(key) | about | {"date": now()})


def _runs(sizes, indices):
    """Yield the key of each row. A relaxation has no time limit, so that column stays empty."""
    for n, index, (total_window, agents), method in itertools.product(sizes, indices, SETTINGS, CONIC_METHODS):
        setting = dict(zip(INSTANCE, (n, index, total_window, agents)))
        yield setting | {"method": method, "modeler": "cvxpy", "solver": "clarabel", "time_limit": None}


def _measure(key):
    instance = paper_instance(*(key[name] for name in INSTANCE))
    start = time.perf_counter()
    bound = relax(instance, key["method"], key["modeler"])
    solve_time = time.perf_counter() - start
    return {
        "status": "relaxed",
        "bound": bound,
        "solve_time_s": round(solve_time, 4),
        "solver_version": f"clarabel {metadata.version('clarabel')}",
        "modeler_version": f"cvxpy {metadata.version('cvxpy')}",
        "threads": 1,
    }
