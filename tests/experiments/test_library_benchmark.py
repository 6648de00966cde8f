"""The search for what is best known of the library: its settings, what is left to do, and runs that become lines."""

import csv
import sys

import pytest

from benchmarks import library as benchmark
from mamttsp import InputError, load
from mamttsp.experiments.campaigns.runs import LibraryRun, Run, run_of
from mamttsp.experiments.campaigns.worker import measure
from mamttsp.experiments.summaries.best_solutions import CHANGES, TABLE, line_faults
from mamttsp.experiments.verification import verify
from mamttsp.library import FOLDER, load_for, parameters

NAME = "loose-n10-i00-w37"


@pytest.fixture
def folder(tmp_path):
    (tmp_path / f"{NAME}.json").write_bytes((FOLDER / f"{NAME}.json").read_bytes())
    (tmp_path / "manifest.json").write_text('{"files": {}}')
    return tmp_path


def _lines(folder, name=TABLE):
    with (folder / name).open(newline="") as file:
        return list(csv.DictReader(file))


def test_the_settings_are_of_every_instance_beyond_the_paper_and_few_agents_come_last():
    found = [setting for series in benchmark.AGENTS for setting in benchmark.settings(series)]
    assert {name for name, _ in found} == {name for name in parameters() if not name.startswith("n")}
    assert len(set(found)) == len(found) == 80 + 60 + 30 + 20 + 18
    assert all(load_for(*setting).n_agents == setting[1] for setting in found)
    crowded = benchmark.settings("crowded")
    assert crowded[0] == ("crowded-n20-i00-w40", 3) and crowded[-1] == ("crowded-n25-i09-w60", 1)


def test_what_has_a_line_is_done_and_what_is_open_is_done_on_request(folder):
    wanted = [(NAME, 1), (NAME, 2), (NAME, 3)]
    assert benchmark.runs_left(folder, wanted, 5.0) == [LibraryRun(*setting, 5.0) for setting in wanted]
    (folder / TABLE).write_text(f"name,agents,status\n{NAME},1,optimal\n{NAME},2,feasible\n")
    assert benchmark.runs_left(folder, wanted, 5.0) == [LibraryRun(NAME, 3, 5.0)]
    assert benchmark.runs_left(folder, wanted, 5.0, again=True) == [LibraryRun(NAME, 2, 5.0)]


def test_a_run_becomes_a_line_with_checked_tours(folder):
    benchmark.improve(folder, [LibraryRun(NAME, 2, 60.0)], quiet=True)
    (line,) = _lines(folder)
    assert (line["status"], line["objective_by"], line["bound_by"]) == ("optimal", "exact", "exact")
    assert line_faults(folder, line) == [] == [fault for _, faults in verify(folder) for fault in faults]
    benchmark.improve(folder, benchmark.runs_left(folder, [(NAME, 2)], 60.0), quiet=True)
    assert _lines(folder) == [line] and _lines(folder, CHANGES) == []


def test_a_run_that_finds_nothing_is_told_and_leaves_no_line(folder, capsys):
    dies = (sys.executable, "-c", "raise SystemExit('out of luck')")
    benchmark.improve(folder, [LibraryRun(NAME, 2, 5.0)], command=dies, quiet=True)
    assert capsys.readouterr().out == f"{NAME}, 2 agents: crashed exit status 1: out of luck\n"
    assert not (folder / TABLE).exists()


def test_types_have_a_number_of_their_own_and_no_sizes():
    name = "types-n10-i00-w40"
    answer = measure(LibraryRun(name, 3, 60.0))
    assert answer["status"] == "optimal" and "V" not in answer
    assert load_for(name, 3) == load(name)
    with pytest.raises(InputError, match=f"^agents: {name} has 3, found 2$"):
        load_for(name, 2)


def test_a_run_is_told_by_its_fields():
    of_library = {"name": NAME, "agents": 2, "time_limit": 5.0}
    of_paper = {"n": 5, "index": 0, "total_window": 40, "agents": 1, "method": "exact", "modeler": None, "solver": None}
    assert run_of(of_library) == LibraryRun(**of_library)
    assert run_of(of_paper | {"time_limit": 5.0}) == Run(**of_paper, time_limit=5.0)
    assert run_of(of_library).instance() == load(NAME, 2)
    with pytest.raises(InputError, match="^time_limit"):
        LibraryRun(NAME, 2, 0.0)
