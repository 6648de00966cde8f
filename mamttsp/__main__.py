"""The command line: `python -m mamttsp generate | solve | check | campaign | tables | figures | versions`.

Exit status: 0 done; 1 no answer, or a solution that is wrong; 2 bad input or usage, with one line on standard error.
"""

import argparse
import sys
from pathlib import Path

from .agents import Agents
from .backends import MODELERS, SOLVERS
from .display import ProgressLine
from .generate import generate
from .instance import Instance
from .solution import Solution
from .solve import ALL_METHODS, solve
from .tours import TourError, check
from .validation import InputError, counted
from .versions import versions


class _Parser(argparse.ArgumentParser):
    """Says what is wrong with the usage in one line."""

    def error(self, message):
        raise InputError(f"{self.prog}: {message}")


def main(argv=None):
    """Run the command line and return its exit status."""
    try:
        arguments = _parser().parse_args(argv)
        return arguments.run(arguments)
    except InputError as error:
        print(error, file=sys.stderr)
        return 2
    except (TourError, _flow_error()) as error:
        print(f"wrong: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        return 1


def _flow_error():
    """Return FlowError, imported only when something has gone wrong: `flow` takes its time."""
    from .flow import FlowError

    return FlowError


def _generate(arguments):
    _check_writable(arguments.output)
    fleet = {"n_agents": arguments.agents} if arguments.type is None else {"agents": _types(arguments.type)}
    if arguments.type is not None and arguments.agents != 1:
        raise InputError("--agents: give either --agents or --type, which has a count")
    demands = {} if arguments.demands is None else {"demands": _numbers("--demands", arguments.demands)}
    instance = generate(arguments.targets, arguments.window, seed=arguments.seed, **fleet, **demands)
    instance.write(arguments.output)
    print(f"{arguments.output}: {counted(instance.n_targets, 'target')}, {counted(instance.n_agents, 'agent')}")
    return 0


def _types(texts):
    """Return the Agents of each --type, a list of texts field=value with the fields of an instance file."""
    entries = []
    for k, fields in enumerate(texts):
        where = f"--type {k}"
        pairs = [field.partition("=")[::2] for field in fields]
        entry = {name: _numbers(f"{where}.{name}", value) for name, value in pairs}
        if isinstance(entry.get("count"), float) and entry["count"].is_integer():
            entry["count"] = int(entry["count"])
        entries.append(Agents.from_dict(entry, where))
    return entries


def _numbers(name, text):
    """Return a number, or a list of them where there are commas."""
    try:
        numbers = [float(part) for part in text.split(",")]
    except ValueError:
        raise InputError(f"{name}: expected a number, or numbers with commas between them, found {text!r}") from None
    return numbers if "," in text else numbers[0]


def _solve(arguments):
    instance = _read_instance(arguments)
    if arguments.output:
        _check_writable(arguments.output)
    with ProgressLine(sys.stderr, on=not (arguments.quiet or arguments.verbose)) as line:
        solution = solve(
            instance,
            method=arguments.method,
            modeler=arguments.modeler,
            solver=arguments.solver,
            time_limit=arguments.time_limit,
            gap=arguments.gap,
            threads=arguments.threads,
            seed=arguments.seed,
            verbose=arguments.verbose,
            progress=None if arguments.verbose else line,
            prune=arguments.prune,
        )
    if arguments.output:
        solution.write(arguments.output)
    if not arguments.quiet:
        print(solution)
    return 0 if solution.tours else 1


def _check(arguments):
    instance, solution = _read_instance(arguments), Solution.read(arguments.solution)
    length = check(instance, solution)
    if solution.objective is None or abs(solution.objective - length) > 1e-6 * max(length, instance.size):
        raise TourError(f"objective: the file says {solution.objective}, the tours' length is {length:.9g}")
    print(f"correct: {counted(len(solution.tours), 'tour')}, total length {length:.9g}")
    return 0


def _campaign(arguments):
    from .experiments import campaign, profile, summary  # here: file locks are of Unix, and the other commands are not

    _check_writable(arguments.results)
    runs = profile(arguments.profile, arguments.solver)
    how = {"memory_limit": arguments.memory_limit, "quiet": arguments.quiet, "scheduler": arguments.scheduler}
    elsewhere = campaign(runs, arguments.results, arguments.jobs, **how)
    if not arguments.quiet:
        print(f"{arguments.results}: {summary(runs, arguments.results)}")
    if elsewhere:
        print(f"{len(elsewhere)} runs are in flight in another campaign on this file", file=sys.stderr)
    return 0


def _tables(arguments):
    from .experiments.build_tables import build_tables  # here: as above

    for path in build_tables(arguments.results):
        print(path)
    return 0


def _figures(arguments):
    from .experiments.build_figures import build  # here: it needs experiments, as above

    if not Path(arguments.out).is_dir():
        raise InputError(f"--out {arguments.out}: there is no such folder")
    for path in build(arguments.results, arguments.out):
        print(f"{path}.pdf, {path}.png")
    return 0


def _versions(arguments):
    print(versions())
    return 0


def _read_instance(arguments):
    instance = Instance.read(arguments.instance)
    return instance if arguments.agents is None else instance.with_agents(arguments.agents)


def _check_writable(path):
    """Find out before a long solve, not after it, that its answer has no place to go."""
    folder = Path(path).parent
    if not folder.is_dir():
        raise InputError(f"{path}: cannot be written: there is no folder {folder}")


def _parser():
    parser = _Parser(prog="mamttsp", description="The multi-agent moving-target traveling salesman problem.")
    names = "generate | solve | check | campaign | tables | figures | versions"
    commands = parser.add_subparsers(required=True, metavar=names)

    command = commands.add_parser("generate", help="write a random instance of the paper's kind")
    command.add_argument("--targets", type=int, required=True, metavar="N")
    command.add_argument("--window", type=float, required=True, metavar="SECONDS", help="total window of each target")
    command.add_argument("--agents", type=int, default=1, metavar="M")
    command.add_argument(
        "--type",
        action="append",
        nargs="+",
        metavar="FIELD=VALUE",
        help="instead of --agents, once for each type: count=2 depot=0,0 max_speed=4 end=9,0 capacity=5",
    )
    command.add_argument("--demands", metavar="D", help="of all targets, or of each with commas between them")
    command.add_argument("--seed", type=int, default=0)
    command.add_argument("-o", "--output", required=True, metavar="FILE")
    command.set_defaults(run=_generate)

    command = commands.add_parser("solve", help="solve an instance")
    command.add_argument("instance", metavar="INSTANCE")
    _add_solve_options(command)
    command.set_defaults(run=_solve)

    command = commands.add_parser("check", help="check a solution, independently of what produced it")
    command.add_argument("instance", metavar="INSTANCE")
    command.add_argument("solution", metavar="SOLUTION")
    command.add_argument("--agents", type=int, metavar="M", help="as given to solve")
    command.set_defaults(run=_check)

    command = commands.add_parser("campaign", help="many runs, a row of a CSV file each; started again, it goes on")
    command.add_argument("--profile", required=True, help="smoke, reduced, full or exact")
    command.add_argument("--results", required=True, metavar="FILE.csv")
    command.add_argument("--jobs", type=int, metavar="N", help="runs at the same time (default: 1)")
    command.add_argument("--scheduler", metavar="ADDRESS", help="of a dask.distributed cluster that does the runs")
    command.add_argument("--solver", help="of the profile full (default: scip)")
    command.add_argument("--memory-limit", type=float, default=4000, metavar="MB", help="for each run (default: 4000)")
    command.add_argument("--quiet", action="store_true", help="neither progress nor summary")
    command.set_defaults(run=_campaign)

    command = commands.add_parser("tables", help="make best_known.csv and claims.csv again from their rows")
    command.add_argument("--results", default="paper_results", metavar="FOLDER", help="default: paper_results")
    command.set_defaults(run=_tables)

    command = commands.add_parser("figures", help="draw the experiments' figures again from their rows")
    command.add_argument("--results", default="paper_results", metavar="FOLDER", help="default: paper_results")
    command.add_argument("--out", default="figures", metavar="FOLDER", help="default: figures")
    command.set_defaults(run=_figures)

    command = commands.add_parser("versions", help="what to put into a bug report")
    command.set_defaults(run=_versions)
    return parser


def _add_solve_options(command):
    command.add_argument("--method", default="exact", help=f"{', '.join(ALL_METHODS)} (default: exact)")
    command.add_argument("--modeler", help=" or ".join(MODELERS))
    command.add_argument("--solver", help=", ".join(SOLVERS))
    command.add_argument("--agents", type=int, metavar="M", help="instead of the instance's own number")
    command.add_argument("--time-limit", type=float, metavar="SECONDS")
    command.add_argument("--gap", type=float, default=1e-4, help="relative gap that counts as optimal (default: 1e-4)")
    command.add_argument("--threads", type=int, default=1)
    command.add_argument("--seed", type=int, default=0, help="of the solver's own random choices")
    command.add_argument("--prune", action="store_true", help="leave out edges that no agent can fly in time")
    command.add_argument("--verbose", action="store_true", help="the solver's own log instead of a progress line")
    command.add_argument("--quiet", action="store_true", help="neither progress nor result table")
    command.add_argument("-o", "--output", metavar="FILE", help="write the solution as JSON")


if __name__ == "__main__":
    sys.exit(main())
