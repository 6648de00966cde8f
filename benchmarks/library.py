"""What is best known of the library's instances, looked for by the exact solver.

    python -m benchmarks.library SERIES ...            the settings that have no line in best_known.csv yet
    python -m benchmarks.library SERIES ... --open     those whose gap is open, once more

SERIES is one of AGENTS below. Each run is a process of its own; what it found is taken into best_known.csv, best/ and
changes.csv of paper_results/instances as soon as it is done. No times are kept.
"""

import argparse
import contextlib
from pathlib import Path

from mamttsp.experiments import tours_of
from mamttsp.experiments.campaigns.bar import campaign_bar
from mamttsp.experiments.campaigns.campaign import MEMORY_LIMIT, rows_apart
from mamttsp.experiments.campaigns.runs import LibraryRun
from mamttsp.experiments.summaries.best_solutions import TABLE, Contribution, read_lines, update
from mamttsp.library import FOLDER, parameters
from mamttsp.solution import OPTIMAL

#: by series: numbers of agents, by that of targets where it matters; None where the files say it
AGENTS = {
    "types": None,
    "loads": None,
    "crowded": (1, 3),
    "loose": (2,),
    "scale": {25: (3, 5), 30: (3, 5), 40: (3, 5), 50: (10,), 64: (12,), 100: (20,)},
}


def settings(series):
    """Return the (name, agents) of a series, in the order of the targets and, within, of the agents from many to few:
    few agents take the exact solver longer."""
    found = []
    for name, arguments in parameters().items():
        if name.startswith(f"{series}-"):
            own = sum(entry["count"] for entry in arguments.get("agents", ()))
            agents = AGENTS[series] or (own,)
            agents = agents[arguments["n_targets"]] if isinstance(agents, dict) else agents
            found += [(arguments["n_targets"], arguments["total_window"], -m, name) for m in agents]
    return [(name, -few) for _, _, few, name in sorted(found)]


def runs_left(folder, wanted, time_limit, again=False):
    """Return the runs of the (name, agents) wanted that have no line in the folder's table, or, `again`, whose line has
    an open gap."""
    lines = read_lines(Path(folder) / TABLE)
    known = {(line["name"], int(line["agents"])): line["status"] for line in lines}
    left = [each for each in wanted if (each in known and known[each] != OPTIMAL if again else each not in known)]
    return [LibraryRun(*each, time_limit) for each in left]


def improve(folder, runs, jobs=1, command=None, quiet=False):
    """Do the runs and take what each found into the folder; command: see `campaign`. What found nothing is told."""
    with (
        campaign_bar(len(runs), 0, quiet) as bar,
        contextlib.closing(rows_apart(runs, jobs, MEMORY_LIMIT, bar, command)) as rows,
    ):
        for row in rows:
            tours, bound = tours_of({"tours": row.get("tours")}), row.get("bound")
            if tours or bound is not None:
                found = tours, bound, LibraryRun.method, LibraryRun.method
                update(folder, [Contribution(row["name"], row["agents"], *found)])
            else:
                print(f"{row['name']}, {row['agents']} agents: {row['status']} {row.get('message', '')}".rstrip())
            bar.update()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("series", nargs="+", choices=AGENTS, metavar="SERIES", help=", ".join(AGENTS))
    parser.add_argument("--open", action="store_true", help="settings that have a line with an open gap")
    parser.add_argument("--time-limit", type=float, default=120.0, help="s for each run")
    parser.add_argument("--jobs", type=int, default=1, help="runs at the same time")
    given = parser.parse_args()
    for series in given.series:
        improve(FOLDER, runs_left(FOLDER, settings(series), given.time_limit, given.open), given.jobs)


if __name__ == "__main__":
    main()
