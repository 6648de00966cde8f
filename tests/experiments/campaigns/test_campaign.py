"""Campaigns: resumed after a kill, shared between processes, and going on when a run's process does not."""

import dataclasses
import os
import signal
import subprocess
import sys

import psutil
import pytest

from mamttsp import InputError, check, paper_instance
from mamttsp.__main__ import main
from mamttsp.experiments import Run, campaign, profile, read_rows, tours_of
from mamttsp.experiments.campaigns import process, runs
from mamttsp.experiments.campaigns.rows import PROVENANCE
from mamttsp.experiments.campaigns.worker import measure
from tests.experiments.fakes import (
    FAKE_WORKER,
    children,
    fake_run,
    indices,
    largest_file,
    start_campaign,
    wait_for_rows,
    wait_until,
)

CLARABEL = Run(5, 0, 20, 1, "micp", "cvxpy", "clarabel", 30)


def _gone(processes):
    return all(not child.is_running() or child.status() == psutil.STATUS_ZOMBIE for child in processes)


def _variant(n, index=0):
    """Return a fake run of the kind that `n` stands for."""
    return dataclasses.replace(fake_run(index), n=n)


def test_killed_at_any_moment_a_campaign_goes_on_from_its_rows(tmp_path):
    path, log = tmp_path / "rows.csv", tmp_path / "log"
    command = (*FAKE_WORKER, str(log))
    for rows in (2, 5):
        killed = start_campaign(path, 10, 0.2, command)
        wait_for_rows(path, rows, killed)
        runs_in_flight = children(killed)
        before = path.read_bytes()
        killed.kill()
        assert killed.wait() == -signal.SIGKILL
        wait_until(lambda: _gone(runs_in_flight))
        assert path.read_bytes().startswith(before)
    output, errors = start_campaign(path, 10, 0.2, command).communicate(timeout=60)
    assert output == "0\n", errors
    assert path.read_bytes().startswith(before) and indices(path) == list(range(10))
    # Each kill costs at most the runs of its two jobs, and one whose row was not written yet for each of them.
    assert len(log.read_text().split()) <= 10 + 2 * 4


def test_a_real_campaign_is_killed_and_resumed_and_its_rows_say_where_they_come_from(tmp_path, monkeypatch, capsys):
    path = tmp_path / "rows.csv"
    script = f"""
from mamttsp.__main__ import main
from mamttsp.experiments.campaigns import runs
runs._SMOKE = (("micp", "clarabel"),)
main({_command(path, "smoke")})"""
    killed = subprocess.Popen([sys.executable, "-c", script], stderr=subprocess.PIPE, text=True)
    wait_for_rows(path, 1, killed)
    killed.kill()
    killed.communicate()
    before = path.read_bytes()
    monkeypatch.setattr(runs, "_SMOKE", (("micp", "clarabel"),))
    assert main([*_command(path, "smoke")[:-1], "--jobs", "2"]) == 0
    out, err = capsys.readouterr()
    assert out == f"{path}: 2 of 2 runs: 2 optimal\n" and err.startswith("2 of 2 runs after ")
    assert path.read_bytes().startswith(before) and len(read_rows(path)) == 2
    for row in read_rows(path):
        length = check(paper_instance(5, 0, 20, int(row["agents"])), tours_of(row))
        assert float(row["objective"]) == pytest.approx(length, abs=1e-9)
        assert all(row[name] for name in PROVENANCE if name != "commit")  # there is none outside a repository
        assert row["solver_version"].startswith("clarabel ") and row["modeler_version"].startswith("cvxpy ")
        assert (row["threads"], row["gap_limit"]) == ("1", "0.0001")


def test_two_campaigns_share_one_file(tmp_path):
    path, log = tmp_path / "rows.csv", tmp_path / "log"
    both = [start_campaign(path, 40, 0.2, (*FAKE_WORKER, str(log))) for _ in range(2)]
    for one in both:
        _, errors = one.communicate(timeout=120)
        assert one.returncode == 0, errors
    assert indices(path) == list(range(40))
    assert sorted(map(int, log.read_text().split())) == list(range(40))  # none was done twice, so the work was shared


def test_a_run_in_flight_elsewhere_is_reported_and_not_done_twice(tmp_path):
    path = tmp_path / "rows.csv"
    other = start_campaign(path, 1, 30)
    children(other)
    assert campaign([fake_run(0, 30.0), fake_run(1)], path, quiet=True, command=FAKE_WORKER) == [fake_run(0, 30.0)]
    other.kill()
    other.communicate()
    assert indices(path) == [1]


def test_a_finished_campaign_changes_nothing(tmp_path):
    path, todo = tmp_path / "rows.csv", [fake_run(index) for index in range(3)]
    campaign(todo, path, quiet=True, command=FAKE_WORKER)
    before = path.read_bytes()
    assert campaign(todo, path, jobs=2, quiet=True, command=FAKE_WORKER) == []
    assert path.read_bytes() == before


@pytest.mark.parametrize("jobs", [1, 2])
def test_a_run_that_fails_is_a_row_and_the_campaign_goes_on(tmp_path, jobs):
    path, todo = tmp_path / "rows.csv", [_variant(1), _variant(2), _variant(3), fake_run(0), fake_run(1)]
    assert campaign(todo, path, jobs, memory_limit=200, quiet=True, command=FAKE_WORKER) == []
    found = {(row["n"], row["index"]): row for row in read_rows(path)}
    statuses = {key: row["status"] for key, row in found.items()}
    ends = {("1", "0"): "crashed", ("2", "0"): "memory", ("3", "0"): "crashed"}
    assert statuses == ends | {("5", "0"): "optimal", ("5", "1"): "optimal"}
    assert found["1", "0"]["message"] == "SIGABRT"
    assert found["3", "0"]["message"] == "exit status 1: the solver gave up"
    assert float(found["2", "0"]["memory_mb"]) >= 200


def test_a_worker_that_is_killed_is_a_row_and_the_campaign_goes_on(tmp_path):
    path = tmp_path / "rows.csv"
    running = start_campaign(path, 3, 1.5)
    children(running)[0].kill()
    _, errors = running.communicate(timeout=60)
    assert running.returncode == 0, errors
    assert sorted((row["status"], row["message"]) for row in read_rows(path)) == [
        ("crashed", "SIGKILL"),
        ("optimal", ""),
        ("optimal", ""),
    ]


def test_a_run_that_never_ends_is_ended(tmp_path, monkeypatch):
    monkeypatch.setattr(process, "_GRACE", 0.2)
    campaign([_variant(4), fake_run(1)], tmp_path / "rows.csv", quiet=True, command=FAKE_WORKER)
    assert [row["status"] for row in read_rows(tmp_path / "rows.csv")] == ["overrun", "optimal"]


def test_the_real_worker_keeps_to_its_memory_limit(tmp_path):
    campaign([CLARABEL], tmp_path / "rows.csv", memory_limit=40, quiet=True)
    (row,) = read_rows(tmp_path / "rows.csv")
    assert (row["status"], row["objective"], row["memory_limit_mb"]) == ("memory", "", "40")


def test_an_exception_in_the_real_worker_is_a_row(tmp_path):
    campaign([dataclasses.replace(CLARABEL, modeler="abacus")], tmp_path / "rows.csv", quiet=True)
    (row,) = read_rows(tmp_path / "rows.csv")
    assert row["status"] == "error" and row["message"].startswith("InputError: modeler: expected one of pyomo, cvxpy")


def test_interrupted_it_ends_its_runs_and_keeps_its_rows(tmp_path):
    path = tmp_path / "rows.csv"
    campaign([fake_run(9)], path, quiet=True, command=FAKE_WORKER)
    running = start_campaign(path, 4, 50)
    runs_in_flight = children(running, 2)
    os.killpg(running.pid, signal.SIGINT)  # as a terminal does
    running.communicate(timeout=20)
    assert running.returncode != 0
    wait_until(lambda: _gone(runs_in_flight), 10)
    assert indices(path) == [9]


@pytest.mark.parametrize("cpu_time", [0.0, 4.0])
def test_runs_do_not_outlive_a_killed_campaign(tmp_path, cpu_time):
    long = Run(10, 0, 40, 3, "baseline", "pyomo", "scip", 200)
    script = f"from mamttsp.experiments import Run, campaign\ncampaign([{long!r}], {str(tmp_path / 'rows.csv')!r})"
    killed = subprocess.Popen([sys.executable, "-c", script], stderr=subprocess.DEVNULL)
    (worker,) = children(killed)
    wait_until(lambda: worker.cpu_times().user >= cpu_time)  # while it still loads, and while it solves
    killed.kill()
    killed.wait()
    wait_until(lambda: _gone([worker]), 20)


@pytest.mark.parametrize("jobs", [1, 2])
def test_a_full_disk_ends_the_campaign_with_one_line_and_it_goes_on_later(tmp_path, recwarn, jobs):
    path, todo = tmp_path / "rows.csv", [fake_run(index) for index in range(5)]
    campaign(todo[:1], path, quiet=True, command=FAKE_WORKER)
    before = path.read_bytes()
    with largest_file(len(before) + 9), pytest.raises(InputError, match="cannot be written: File too large") as error:
        campaign(todo, path, jobs, quiet=True, command=FAKE_WORKER)
    assert "\n" not in str(error.value) and not recwarn.list and path.read_bytes() == before
    assert campaign(todo, path, jobs, quiet=True, command=FAKE_WORKER) == []
    assert indices(path) == [0, 1, 2, 3, 4]


def test_bad_arguments_are_refused_before_any_run(tmp_path):
    for changed, message in (({"jobs": 0}, "jobs: "), ({"memory_limit": -1}, "memory_limit: ")):
        with pytest.raises(InputError, match=message):
            campaign([fake_run(0)], tmp_path / "rows.csv", quiet=True, command=FAKE_WORKER, **changed)
    with pytest.raises(InputError, match="time_limit: "):
        dataclasses.replace(CLARABEL, time_limit=0)
    assert not (tmp_path / "rows.csv").exists()


@pytest.mark.parametrize("method", ["baseline", "micp"])
def test_a_row_has_the_sizes_of_its_model(method):
    from mamttsp.formulations import build_formulation
    from mamttsp.graph import build_graph

    answer = measure(Run(5, 1, 20, 2, method, "pyomo", "scip", 0.5))
    graph = build_graph(paper_instance(5, 1, 20, 2))
    sizes = build_formulation(method, "pyomo", graph, 2).statistics()._asdict()
    assert {name: answer[name] for name in sizes} == sizes
    assert (answer["V"], answer["E"]) == (len(graph.tau), len(graph.edges))


def _command(path, name):
    return ["campaign", "--profile", name, "--results", str(path), "--quiet"]


@pytest.mark.parametrize(
    "name, more, message",
    [
        ("big", [], "profile: expected one of smoke, reduced, claims, full, exact, found 'big'"),
        ("full", ["--solver", "abacus"], "solver: expected one of"),
        ("smoke", ["--jobs", "0"], "jobs: expected a whole number of at least 1, found 0"),
    ],
)
def test_the_command_says_what_is_wrong(tmp_path, capsys, name, more, message):
    assert main([*_command(tmp_path / "rows.csv", name), *more]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.count("\n") == 1 and err.startswith(message)


@pytest.mark.slow
def test_smoke_does_every_run(tmp_path):
    path = tmp_path / "rows.csv"
    assert main([*_command(path, "smoke"), "--jobs", "2"]) == 0
    rows = read_rows(path)
    assert len(rows) == len(profile("smoke"))
    assert {row["status"] for row in rows} <= {"optimal", "feasible", "unknown"}  # 5 s may be short on a busy machine
    assert {"exact", "micp"} <= {row["method"] for row in rows if row["status"] == "optimal"}
    for row in rows:
        if row["status"] == "unknown":
            continue
        length = check(paper_instance(5, 0, 20, int(row["agents"])), tours_of(row))
        assert float(row["objective"]) == pytest.approx(length)
