"""Give the MICP on SCIP ten times its limit, for its time over ours where 60 s cut it off.

    python -m benchmarks.longer            the runs that have no row in paper_results/longer.csv yet, one after another

Instance 0 of n = 10 and 15 in all seven settings, within 600 s each.
"""

import argparse
from pathlib import Path

from mamttsp.experiments import campaign
from mamttsp.experiments.campaigns.runs import SETTINGS, Run

RESULTS = Path(__file__).parent.parent / "paper_results" / "longer.csv"
RUNS = [Run(n, 0, window, m, "micp", "pyomo", "scip", 600) for n in (10, 15) for window, m in SETTINGS]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=RESULTS, help="the CSV file to append to")
    campaign(RUNS, parser.parse_args().results)


if __name__ == "__main__":
    main()
