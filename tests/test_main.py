"""The command line: what it writes, its exit status, and one line on standard error for bad input."""

import io
import json
import runpy
import subprocess
import sys

import pytest

from mamttsp import Agents, Instance, Progress, Solution, Tour, Visit
from mamttsp.__main__ import main
from mamttsp.arguments import parser
from mamttsp.display import ProgressLine, format_progress
from tests.examples import instance, still
from tests.oracle import optimum

EAST, NORTH = Tour((Visit(0, 2.5, (10.0, 0.0)),), 5.0), Tour((Visit(1, 2.5, (0.0, 10.0)),), 5.0)


@pytest.fixture
def problem(tmp_path):
    path = tmp_path / "instance.json"
    instance(still(10, 0), still(0, 10), n_agents=2).write(path)
    return str(path)


#: `generate` with a type that is not complete yet
_TYPES = ["generate", "--targets", "3", "--window", "20", "-o", "i.json", "--type", "count=1", "depot=0,0"]


def _one_line(capsys):
    out, err = capsys.readouterr()
    assert out == "" and err.count("\n") == 1 and "Traceback" not in err
    return err


def test_generate_solve_check(tmp_path, capsys):
    problem, answer = str(tmp_path / "i.json"), str(tmp_path / "s.json")
    assert main(["generate", "--targets", "3", "--window", "20", "--agents", "2", "--seed", "7", "-o", problem]) == 0
    written = Instance.read(problem)
    assert (written.n_targets, written.n_agents) == (3, 2)
    assert main(["solve", problem, "--method", "micp", "--solver", "scip", "--time-limit", "60", "-o", answer]) == 0
    solution = Solution.read(answer)
    assert solution.status == "optimal" and solution.objective == pytest.approx(optimum(written), rel=1e-4)
    capsys.readouterr()
    assert main(["check", problem, answer]) == 0
    assert "total length" in capsys.readouterr().out


def test_generate_types_and_demands(tmp_path, capsys):
    problem = str(tmp_path / "instance.json")
    first, second = (
        ["count=2", "depot=0,0", "max_speed=4"],
        ["count=1", "depot=40,0", "max_speed=6", "end=0,0", "capacity=5"],
    )
    command = [
        "generate",
        "--targets",
        "3",
        "--window",
        "20",
        "--type",
        *first,
        "--type",
        *second,
        "--demands",
        "1,2,3",
    ]
    assert main([*command, "-o", problem]) == 0
    assert capsys.readouterr().out == f"{problem}: 3 targets, 3 agents\n"
    instance = Instance.read(problem)
    assert instance.agents == (Agents(2, (0, 0), 4.0), Agents(1, (40, 0), 6.0, (0, 0), 5.0))
    assert [target.demand for target in instance.targets] == [1.0, 2.0, 3.0]


def test_the_table_names_the_numbers_and_the_visits(problem, capsys):
    assert main(["solve", problem, "--method", "micp", "--solver", "scip"]) == 0
    out = capsys.readouterr().out
    assert "status        optimal" in out and "objective     34.1421" in out and "back at" in out


def test_quiet_prints_nothing(problem, capfd):
    assert main(["solve", problem, "--method", "micp", "--solver", "scip", "--quiet"]) == 0
    assert capfd.readouterr() == ("", "")


def test_agents_replace_the_instances_own_number(problem, tmp_path):
    answer = str(tmp_path / "s.json")
    data = json.loads(open(problem).read())
    for target, end in zip(data["targets"], (3.0, 3.0)):
        target["windows"] = [[2.5, end]]
    open(problem, "w").write(json.dumps(data))
    run = ["solve", problem, "--method", "micp", "--solver", "scip", "--quiet", "-o", answer]
    assert main([*run, "--agents", "1"]) == 1 and Solution.read(answer).status == "infeasible"
    assert main([*run, "--agents", "3"]) == 0 and len(Solution.read(answer).tours) == 2
    assert main(["check", problem, answer, "--agents", "2"]) == 0
    assert main(["check", problem, answer, "--agents", "1"]) == 1


def test_check_tells_what_is_wrong(problem, tmp_path, capsys):
    answer = tmp_path / "s.json"
    main(["solve", problem, "--method", "micp", "--solver", "scip", "--quiet", "-o", str(answer)])
    data = json.loads(answer.read_text())
    answer.write_text(json.dumps(data | {"objective": 30.0}))
    assert main(["check", problem, str(answer)]) == 1
    assert "objective: the file says 30.0" in capsys.readouterr().err
    answer.write_text(json.dumps(data | {"tours": []}))
    assert main(["check", problem, str(answer)]) == 1
    assert "target 0 is visited 0 times" in capsys.readouterr().err


def test_a_limit_with_nothing_found_is_exit_status_1(tmp_path, monkeypatch, problem, capsys):
    nothing = Solution("unknown", None, 5.0, 1.0, (), "micp", "scip 10.0")
    monkeypatch.setattr("mamttsp.__main__.solve", lambda *_, **__: nothing)
    assert main(["solve", problem]) == 1
    assert "status        unknown" in capsys.readouterr().out


def test_options_reach_solve(problem, monkeypatch):
    seen = {}
    nothing = Solution("unknown", None, None, 0.0, (), "", "")
    monkeypatch.setattr("mamttsp.__main__.solve", lambda _, **given: seen.update(given) or nothing)
    choices = "--method baseline --modeler cvxpy --solver scip --prune --verbose"
    numbers = "--time-limit 9 --gap 0.1 --threads 2 --seed 3"
    main(["solve", problem, *choices.split(), *numbers.split()])
    del seen["progress"]
    assert seen == {
        "method": "baseline", "modeler": "cvxpy", "solver": "scip", "time_limit": 9.0, "gap": 0.1,
        "threads": 2, "seed": 3, "prune": True, "verbose": True, "start": None,
    }  # fmt: skip


@pytest.mark.parametrize(
    "arguments, message",
    [
        (["solve", "nowhere.json"], "nowhere.json: cannot be read"),
        (["check", "nowhere.json", "s.json"], "nowhere.json: cannot be read"),
        (["generate", "--targets", "0", "--window", "20", "-o", "i.json"], "n_targets: expected a whole number"),
        (["generate", "--targets", "2", "--window", "20", "-o", "no/folder/i.json"], "there is no folder"),
        (_TYPES, "--type 0.max_speed: missing"),
        (
            [*_TYPES, "max_speed=fast"],
            "--type 0.max_speed: expected a number, or numbers with commas between them, found 'fast'",
        ),
        ([*_TYPES, "max_speed=4", "speed=4"], "--type 0.speed: unknown; an entry has count"),
        ([*_TYPES, "max_speed=4", "--agents", "2"], "--agents: give either --agents or --type"),
        ([*_TYPES, "max_speed=4", "--demands", "1,2"], "demands: expected the shape 3, found 2"),
        (["generate", "--targets", "two", "--window", "20", "-o", "i.json"], "invalid int value: 'two'"),
        (["solve"], "required: INSTANCE"),
        (["fly"], "invalid choice: 'fly'"),
        ([], "required"),
    ],
)
def test_bad_usage_is_exit_status_2_and_one_line(arguments, message, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(arguments) == 2
    assert message in _one_line(capsys)


@pytest.mark.parametrize(
    "arguments, message",
    [
        (["--method", "magic"], "method: expected one of"),
        (["--method", "micp", "--solver", "magic"], "solver: expected one of"),
        (["--method", "micp", "--modeler", "magic"], "modeler: expected one of"),
        (["--method", "nonconvex", "--modeler", "cvxpy"], "modeler: cvxpy cannot state"),
        (["--agents", "0"], "n_agents: expected a whole number"),
        (["--time-limit", "-1"], "time_limit: expected a number above 0"),
        (["--gap", "nan"], "gap: expected a number"),
        (["-o", "no/folder/s.json"], "there is no folder"),
    ],
)
def test_bad_options_of_solve_are_exit_status_2_and_one_line(arguments, message, problem, capsys):
    assert main(["solve", problem, *arguments]) == 2
    assert message in _one_line(capsys)


@pytest.mark.parametrize("text", ["not json", "[]", '{"format": "mamttsp-instance", "version": 1}'])
def test_a_broken_file_is_named(text, tmp_path, capsys):
    path = tmp_path / "broken.json"
    path.write_text(text)
    assert main(["solve", str(path)]) == 2
    assert _one_line(capsys).startswith(f"{path}: ")


def test_a_missing_solver_is_exit_status_2_and_one_line(problem, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "mosek", None)
    monkeypatch.delitem(sys.modules, "mamttsp.backends.mosek", raising=False)
    assert main(["solve", problem, "--method", "micp", "--solver", "mosek"]) == 2
    assert "solver: mosek is not installed" in _one_line(capsys)


def test_one_agent_is_one_agent(tmp_path, capsys):
    problem = str(tmp_path / "i.json")
    assert main(["generate", "--targets", "1", "--window", "20", "-o", problem]) == 0
    assert capsys.readouterr().out == f"{problem}: 1 target, 1 agent\n"


def test_a_solve_begins_from_a_solution(problem, tmp_path, capsys):
    answer = str(tmp_path / "s.json")
    run = ["solve", problem, "--method", "micp", "--solver", "scip", "--quiet"]
    assert main([*run, "-o", answer]) == 0 and main([*run, "--start", answer]) == 0
    instance(still(10, 0), still(0, 20)).write(problem)
    assert main([*run, "--start", answer]) == 2
    assert "start: no solution of this instance: " in _one_line(capsys)
    assert main([*run, "--start", "nowhere.json"]) == 2
    assert "nowhere.json: cannot be read" in _one_line(capsys)


def test_an_infeasible_instance_is_told_why(tmp_path, capsys):
    path = str(tmp_path / "i.json")
    instance(still(40, 0, [(0, 5)])).write(path)
    assert main(["solve", path, "--method", "micp", "--solver", "scip"]) == 1
    reason = "no agent can be at target 0 in a window, the last of which closes at 5 s"
    assert f"status        infeasible\nreason        {reason}\n" in capsys.readouterr().out


@pytest.mark.parametrize(
    "suffix, start", [("png", b"\x89PNG"), ("pdf", b"%PDF"), ("svg", b"<?xml"), ("gif", b"GIF89a")]
)
def test_plot_draws_an_instance_and_a_solution(suffix, start, problem, tmp_path, capsys):
    answer, picture = str(tmp_path / "s.json"), tmp_path / f"p.{suffix}"
    Solution("feasible", 40.0, None, 1.0, (EAST, NORTH), "exact", "none").write(answer)
    assert main(["plot", problem, answer, "-o", str(picture)]) == 0
    assert picture.read_bytes().startswith(start) and capsys.readouterr().out == f"{picture}\n"


def test_plot_draws_an_instance_alone(problem, tmp_path):
    assert main(["plot", problem, "-o", str(tmp_path / "p.png")]) == 0
    assert [path.name for path in tmp_path.iterdir() if path.suffix != ".json"] == ["p.png"]


@pytest.mark.parametrize(
    "picture, message",
    [
        ("p.gif", "p.gif: a film shows tours; give a solution"),
        ("p.doc", "p.doc: expected one of .pdf"),
        ("no/folder/p.png", "there is no folder"),
    ],
)
def test_a_picture_that_cannot_be_is_one_line(picture, message, problem, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["plot", problem, "-o", picture]) == 2
    assert message in _one_line(capsys)


def _subparsers():
    whole = parser()
    return next(action for action in whole._actions if action.dest == "command").choices


@pytest.mark.parametrize("command", _subparsers())
def test_every_help_shows_every_default(command, capsys):
    for action in _subparsers()[command]._actions:
        if not action.required and action.nargs != 0:
            assert ("(default: " if action.default is None else "(default: %(default)s") in action.help, action.dest
    with pytest.raises(SystemExit) as ended:
        main([command, "--help"])
    assert ended.value.code == 0 and capsys.readouterr().out.startswith(f"usage: mamttsp {command}")


def test_the_numbers_in_a_help_are_those_that_are_used(capsys):
    with pytest.raises(SystemExit):
        main(["solve", "--help"])
    assert "(default: 0.0001)" in " ".join(capsys.readouterr().out.split())
    assert parser().parse_args(["solve", "i.json"]).gap == 0.0001


def test_versions_name_the_package_the_solvers_and_the_machine(capsys):
    assert main(["versions"]) == 0
    out = capsys.readouterr().out
    for name in ("mamttsp", "Python", "clarabel", "SCIP", "gurobipy", "processor", "cores"):
        assert f"\n{name} " in f"\n{out}"


def test_the_module_runs(monkeypatch, capsys):
    monkeypatch.delitem(sys.modules, "mamttsp.__main__")
    monkeypatch.setattr(sys, "argv", ["mamttsp", "versions"])
    with pytest.raises(SystemExit) as ended:
        runpy.run_module("mamttsp", run_name="__main__")
    assert ended.value.code == 0 and "Python" in capsys.readouterr().out


def test_progress_in_words():
    line = format_progress(Progress(1.25, 200.0, 150.0, 0.25, 12, "scip"))
    assert line == "    1.2 s  incumbent 200.0000  bound 150.0000  gap 25.00 %  nodes 12  scip"
    empty = format_progress(Progress(0.0, None, None, None, None, "dive"))
    assert empty.split() == ["0.0", "s", "incumbent", "-", "bound", "-", "gap", "-", "dive"]


class _Terminal(io.StringIO):
    def isatty(self):
        return True


def test_on_a_terminal_the_line_is_written_over_and_cleared():
    screen = _Terminal()
    steps = Progress(1.0, 200.0, 150.0, 0.25, 12, "scip"), Progress(2.0, None, None, None, None, "scip")
    with ProgressLine(screen) as line:
        for step in steps:
            line(step)
    written = screen.getvalue()
    assert "\n" not in written and all(f"\r{format_progress(step)}" in written for step in steps)
    assert len(written.split("\r")[-2]) >= len(format_progress(steps[1])) and written.endswith(" \r")


def test_elsewhere_lines_come_now_and_then(monkeypatch):
    now = iter([0.0, 1.0, 6.0, 6.0, 7.0])
    monkeypatch.setattr("mamttsp.display.time.monotonic", lambda: next(now))
    stream = io.StringIO()
    with ProgressLine(stream) as line:
        for second in (1.0, 6.0, 7.0):
            line(Progress(second, None, None, None, None, "scip"))
    assert stream.getvalue().count("\n") == 1 and stream.getvalue().startswith("    6.0 s")


def test_no_progress_line_where_it_is_off():
    screen = _Terminal()
    with ProgressLine(screen, on=False) as line:
        line(Progress(1.0, 200.0, 150.0, 0.25, 12, "scip"))
    assert screen.getvalue() == ""


def test_a_reader_that_has_seen_enough_gets_no_traceback():
    asked = "import sys; from mamttsp.__main__ import main; input(); sys.exit(main(['versions']))"
    pipes = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.PIPE)
    with subprocess.Popen([sys.executable, "-c", asked], **pipes) as process:
        process.stdout.close()  # before anything is written
        process.stdin.write(b"\n")
        process.stdin.close()
        complaint = process.stderr.read()
    assert (process.returncode, complaint) == (1, b"")
