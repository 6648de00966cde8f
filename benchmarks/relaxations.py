"""Relax both conic programs on every setting of the paper, and append a row for each to a CSV file.

    python -m benchmarks.relaxations                               all 560 problems, both programs: some 10 minutes
    python -m benchmarks.relaxations --sizes 5 10                  the small ones

What has a row is not done again. The rows are those of a campaign: `paper_results/README.md` explains them.
"""

import argparse
import sys
from pathlib import Path

from mamttsp import InputError
from mamttsp.experiments.campaigns.relaxed_rows import relaxations
from mamttsp.generate import PAPER_SIZES

RESULTS = Path(__file__).parent.parent / "paper_results" / "relaxations.csv"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", type=int, nargs="+", default=PAPER_SIZES, choices=PAPER_SIZES, help="targets")
    parser.add_argument("--results", type=Path, default=RESULTS, help="the CSV file to append to")
    given = parser.parse_args()
    try:
        relaxations(given.results, given.sizes)
    except InputError as error:
        sys.exit(str(error))


if __name__ == "__main__":
    main()
