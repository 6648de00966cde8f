"""The command line, `python -m mamttsp`: what each command does; `arguments` says what it takes.

Exit status: 0 done; 1 no answer, or a solution that is wrong; 2 bad input or usage, with one line on standard error.
"""

import os
import sys
from pathlib import Path

from .arguments import agents_of_types, numbers, parser
from .display import ProgressLine
from .generate import generate
from .instance import Instance
from .look import plot
from .solution import Solution
from .solve import solve
from .tours import TourError, check
from .validation import InputError, counted
from .versions import versions
from .warm_up import PARTS, ensure_compiled

#: of a film, however long the tours take
_PICTURES = 100


def main(argv=None):
    """Run the command line and return its exit status."""
    try:
        arguments = parser().parse_args(argv)
        status = _COMMANDS[arguments.command](arguments)
        sys.stdout.flush()
        return status
    except InputError as error:
        print(error, file=sys.stderr)
        return 2
    except (TourError, _flow_error()) as error:
        print(f"wrong: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        return 1
    except BrokenPipeError:  # whoever reads, such as `head`, has seen enough; what is left has nowhere to go
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1


def _flow_error():
    """Return FlowError, imported only when something has gone wrong: `flow` takes its time."""
    from .flow import FlowError

    return FlowError


def _generate(arguments):
    _check_writable(arguments.output)
    fleet = {"n_agents": arguments.agents} if arguments.type is None else {"agents": agents_of_types(arguments.type)}
    if arguments.type is not None and arguments.agents != 1:
        raise InputError("--agents: give either --agents or --type, which has a count")
    demands = {} if arguments.demands is None else {"demands": numbers("--demands", arguments.demands)}
    instance = generate(arguments.targets, arguments.window, seed=arguments.seed, **fleet, **demands)
    instance.write(arguments.output)
    print(f"{arguments.output}: {counted(instance.n_targets, 'target')}, {counted(instance.n_agents, 'agent')}")
    return 0


def _solve(arguments):
    instance = _read_instance(arguments)
    if arguments.output:
        _check_writable(arguments.output)
    start = None if arguments.start is None else Solution.read(arguments.start)
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
            start=start,
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


def _plot(arguments):
    from . import figures  # here: matplotlib takes its time

    _check_writable(arguments.output)
    instance = Instance.read(arguments.instance)
    solution = None if arguments.solution is None else Solution.read(arguments.solution)
    if Path(arguments.output).suffix.lower() in figures.Film.SUFFIXES:
        if solution is None:
            raise InputError(f"{arguments.output}: a film shows tours; give a solution")
        last = max((tour.return_time for tour in solution.tours), default=0.0)
        figures.film(instance, solution, step=last / _PICTURES or 1.0).save(arguments.output)
    else:
        figures.save(plot(instance, solution), arguments.output)
    print(arguments.output)
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
        are = "is" if len(elsewhere) == 1 else "are"
        print(f"{counted(len(elsewhere), 'run')} {are} in flight in another campaign on this file", file=sys.stderr)
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


def _verify(arguments):
    from .experiments.verification import verify  # here: as above

    wrong = False
    for what, faults in verify(arguments.folder):
        wrong |= bool(faults)
        print("\n".join([*faults, f"{what}: {counted(len(faults), 'fault') if faults else 'correct'}"]), flush=True)
    return int(wrong)


def _versions(arguments):
    if arguments.warm_up:
        for part in PARTS:
            ensure_compiled(part)
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


_COMMANDS = {
    "generate": _generate,
    "solve": _solve,
    "check": _check,
    "plot": _plot,
    "campaign": _campaign,
    "tables": _tables,
    "figures": _figures,
    "verify": _verify,
    "versions": _versions,
}


if __name__ == "__main__":
    sys.exit(main())
