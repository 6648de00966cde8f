"""What the command line takes: its commands, their arguments, and the defaults of these."""

import argparse

from .agents import Agents
from .backends import MODELERS, SOLVERS, STARTS
from .solve import ALL_METHODS
from .validation import InputError

_DEFAULT = "(default: %(default)s)"


class _Parser(argparse.ArgumentParser):
    """Says what is wrong with the usage in one line."""

    def error(self, message):
        raise InputError(f"{self.prog}: {message}")


def parser():
    """Return the parser of the command line; what it returns has the command's name in `command`."""
    whole = _Parser(prog="mamttsp", description="The multi-agent moving-target traveling salesman problem.")
    commands = whole.add_subparsers(required=True, dest="command", metavar="COMMAND")

    command = commands.add_parser("generate", help="write a random instance by the paper's recipe")
    command.add_argument("--targets", type=int, required=True, metavar="N", help="how many")
    command.add_argument("--window", type=float, required=True, metavar="SECONDS", help="total window of each target")
    command.add_argument("--agents", type=int, default=1, metavar="M", help=f"how many, all alike {_DEFAULT}")
    kinds = "instead of --agents, once for each type: count=2 depot=0,0 max_speed=4 end=9,0 capacity=5 (default: none)"
    command.add_argument("--type", action="append", nargs="+", metavar="FIELD=VALUE", help=kinds)
    demands = "of all targets, or of each with commas between them (default: 0)"
    command.add_argument("--demands", metavar="D", help=demands)
    command.add_argument("--seed", type=int, default=0, help=f"the same gives the same trajectories {_DEFAULT}")
    command.add_argument("-o", "--output", required=True, metavar="FILE", help="where to")

    command = commands.add_parser("solve", help="solve an instance")
    command.add_argument("instance", metavar="INSTANCE")
    _add_solve_options(command)

    command = commands.add_parser("check", help="check a solution, independently of what produced it")
    command.add_argument("instance", metavar="INSTANCE")
    command.add_argument("solution", metavar="SOLUTION")
    command.add_argument("--agents", type=int, metavar="M", help="as given to solve (default: the instance's number)")

    command = commands.add_parser("plot", help="draw an instance and a solution from above, or film the solution")
    command.add_argument("instance", metavar="INSTANCE")
    command.add_argument("solution", metavar="SOLUTION", nargs="?", help="(default: none, the instance alone)")
    formats = ".png, .pdf or .svg; a film: .gif, .mp4 (with ffmpeg) or .html"
    command.add_argument("-o", "--output", required=True, metavar="PICTURE", help=formats)

    command = commands.add_parser("campaign", help="many runs, a row of a CSV file each; started again, it goes on")
    command.add_argument("--profile", required=True, help="smoke, reduced, claims, full or exact")
    command.add_argument("--results", required=True, metavar="FILE.csv", help="the rows, appended to those there")
    command.add_argument("--jobs", type=int, metavar="N", help="runs at the same time (default: 1)")
    cluster = "of a dask.distributed cluster that does the runs (default: none, they are done here)"
    command.add_argument("--scheduler", metavar="ADDRESS", help=cluster)
    command.add_argument("--solver", help="of the profile full (default: scip)")
    command.add_argument("--memory-limit", type=float, default=4000, metavar="MB", help=f"for each run {_DEFAULT}")
    command.add_argument("--quiet", action="store_true", help="neither progress nor summary")

    command = commands.add_parser("tables", help="make best_known.csv and claims.csv again from their rows")
    command.add_argument("--results", default="paper_results", metavar="FOLDER", help=f"of the rows {_DEFAULT}")

    command = commands.add_parser("figures", help="draw the experiments' figures again from their rows")
    command.add_argument("--results", default="paper_results", metavar="FOLDER", help=f"of the rows {_DEFAULT}")
    command.add_argument("--out", default="figures", metavar="FOLDER", help=f"where to {_DEFAULT}")

    command = commands.add_parser("verify", help="check every stored tour of a folder, and every file's sum")
    folder = f"with tables of tours, and a manifest of sums {_DEFAULT}"
    command.add_argument("folder", metavar="FOLDER", nargs="?", default="paper_results", help=folder)

    command = commands.add_parser("versions", help="what to put into a bug report")
    command.add_argument("--warm-up", action="store_true", help="compile what is compiled first, for images and CI")
    return whole


def _add_solve_options(command):
    command.add_argument("--method", default="exact", help=f"{', '.join(ALL_METHODS)} {_DEFAULT}")
    open_one = "(default: the fastest open one for the method)"
    command.add_argument("--modeler", help=f"{' or '.join(MODELERS)} {open_one}")
    command.add_argument("--solver", help=f"{', '.join(SOLVERS)} {open_one}")
    command.add_argument("--agents", type=int, metavar="M", help="how many (default: the instance's number)")
    command.add_argument("--time-limit", type=float, metavar="SECONDS", help="of wall time (default: none)")
    command.add_argument("--gap", type=float, default=1e-4, help=f"relative gap that counts as optimal {_DEFAULT}")
    command.add_argument("--threads", type=int, default=1, help=f"handed to the solver {_DEFAULT}")
    command.add_argument("--seed", type=int, default=0, help=f"of the solver's own random choices {_DEFAULT}")
    start = f"solution to begin from, for exact, {', '.join(STARTS)} (default: none)"
    command.add_argument("--start", metavar="FILE", help=start)
    command.add_argument("--prune", action="store_true", help="leave out edges that no agent can fly in time")
    command.add_argument("--verbose", action="store_true", help="the solver's own log instead of a progress line")
    command.add_argument("--quiet", action="store_true", help="neither progress nor result table")
    command.add_argument("-o", "--output", metavar="FILE", help="write the solution as JSON (default: do not)")


def agents_of_types(texts):
    """Return the Agents of each --type, a list of texts field=value with the fields of an instance file."""
    entries = []
    for k, fields in enumerate(texts):
        where = f"--type {k}"
        pairs = [field.partition("=")[::2] for field in fields]
        entry = {name: numbers(f"{where}.{name}", value) for name, value in pairs}
        if isinstance(entry.get("count"), float) and entry["count"].is_integer():
            entry["count"] = int(entry["count"])
        entries.append(Agents.from_dict(entry, where))
    return entries


def numbers(name, text):
    """Return a number, or a list of them where there are commas."""
    try:
        numbers = [float(part) for part in text.split(",")]
    except ValueError:
        raise InputError(f"{name}: expected a number, or numbers with commas between them, found {text!r}") from None
    return numbers if "," in text else numbers[0]
