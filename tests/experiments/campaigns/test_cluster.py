"""Campaigns on a cluster: the same rows, from the machine that did the run, whichever process dies."""

import json
import os
import signal
import subprocess
import sys
from dataclasses import replace

import dask
import distributed
import psutil
import pytest

from mamttsp import InputError, check, paper_instance
from mamttsp.__main__ import main
from mamttsp.experiments import campaign, read_rows, tours_of
from mamttsp.experiments.campaigns import runs
from mamttsp.experiments.campaigns.rows import PROVENANCE
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


@pytest.fixture(scope="module")
def cluster():
    """Two workers with a thread each, in processes that are started again when they die."""
    with dask.config.set({"distributed.scheduler.allowed-failures": 1}):
        size = {"n_workers": 2, "threads_per_worker": 1, "processes": True}
        with distributed.LocalCluster(**size, dashboard_address=None, silence_logs="CRITICAL") as cluster:
            yield cluster


@pytest.fixture
def scheduler(cluster):
    """The address of the cluster, once its workers are all there."""
    wait_until(lambda: len(cluster.scheduler.workers) == 2)
    return cluster.scheduler_address


def _workers(cluster):
    return [psutil.Process(worker.pid) for worker in cluster.workers.values()]


def _gone(processes):
    return all(not process.is_running() or process.status() == psutil.STATUS_ZOMBIE for process in processes)


def test_the_command_sends_its_runs_and_rows_say_which_machine_did_them(tmp_path, cluster, scheduler, monkeypatch):
    path = tmp_path / "rows.csv"

    def another_machine(name):
        from mamttsp.experiments.campaigns import provenance

        provenance.processor = lambda: name

    monkeypatch.setattr(runs, "_SMOKE", (("micp", "clarabel"),))
    with distributed.Client(cluster) as client:
        client.run(another_machine, "abacus")
    command = ["campaign", "--profile", "smoke", "--results", str(path), "--scheduler", scheduler, "--quiet"]
    assert main(command) == 0
    before = path.read_bytes()
    assert main(command) == 0 and path.read_bytes() == before
    assert len(read_rows(path)) == 2
    for row in read_rows(path):
        length = check(paper_instance(5, 0, 20, int(row["agents"])), tours_of(row))
        assert float(row["objective"]) == pytest.approx(length, abs=1e-9)
        assert (row["status"], row["cpu"], row["jobs"]) == ("optimal", "abacus", "2")  # two workers share the machine
        assert all(row[name] for name in PROVENANCE if name != "commit")  # there is none outside a repository


def test_the_runs_of_a_killed_worker_are_done_by_others(tmp_path, cluster, scheduler):
    path, log = tmp_path / "rows.csv", tmp_path / "log"
    running = start_campaign(path, 8, 1.0, (*FAKE_WORKER, str(log)), scheduler)
    wait_for_rows(path, 2, running)
    victim = _workers(cluster)[0]
    run_in_flight = children(victim)
    victim.kill()
    wait_until(lambda: _gone(run_in_flight))
    output, errors = running.communicate(timeout=120)
    assert output == "0\n", errors
    assert indices(path) == list(range(8)) and {row["status"] for row in read_rows(path)} == {"optimal"}
    started = [int(index) for index in log.read_text().split()]
    assert set(started) == set(range(8)) and 9 <= len(started) <= 10  # the one it did, and one it was about to do


def test_a_run_that_kills_each_worker_is_a_row_and_the_campaign_goes_on(tmp_path, scheduler):
    path, killer = tmp_path / "rows.csv", replace(fake_run(0), n=6)
    todo = [fake_run(1), killer, fake_run(2), fake_run(3)]
    assert campaign(todo, path, quiet=True, command=FAKE_WORKER, scheduler=scheduler) == []
    found = {row["index"]: row for row in read_rows(path)}
    assert {index: row["status"] for index, row in found.items()} == dict.fromkeys("123", "optimal") | {"0": "crashed"}
    assert found["0"]["message"].startswith("killed its worker 2 times, at last tcp://")
    assert found["0"]["cpu"] == "" and found["0"]["date"]
    assert all(found[index]["cpu"] for index in "123")


def test_a_run_that_fails_is_a_row_as_on_one_machine(tmp_path, scheduler):
    todo = [*(replace(fake_run(0), n=n) for n in (1, 2, 3)), fake_run(0)]
    found = []
    for where in (scheduler, None):
        path = tmp_path / f"{where is None}.csv"
        assert campaign(todo, path, memory_limit=200, quiet=True, command=FAKE_WORKER, scheduler=where) == []
        found.append({row["n"]: (row["status"], row["message"]) for row in read_rows(path)})
    assert found[0] == found[1]
    assert [found[0][n][0] for n in "1235"] == ["crashed", "memory", "crashed", "optimal"]


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGINT])
def test_runs_do_not_outlive_their_campaign_which_goes_on_when_it_is_started_again(tmp_path, cluster, scheduler, how):
    path = tmp_path / "rows.csv"
    campaign([fake_run(9)], path, quiet=True, command=FAKE_WORKER, scheduler=scheduler)
    running = start_campaign(path, 4, 50, scheduler=scheduler)
    runs_in_flight = [run for worker in _workers(cluster) for run in children(worker)]
    os.killpg(running.pid, how)
    running.communicate(timeout=20)
    assert running.returncode != 0
    wait_until(lambda: _gone(runs_in_flight), 20)
    assert indices(path) == [9]
    todo = [fake_run(index) for index in range(4)]
    assert campaign(todo, path, quiet=True, command=FAKE_WORKER, scheduler=scheduler) == []
    assert indices(path) == [0, 1, 2, 3, 9]


def test_a_cluster_and_a_machine_share_one_file(tmp_path, scheduler):
    path, log = tmp_path / "rows.csv", tmp_path / "log"
    both = [start_campaign(path, 30, 0.3, (*FAKE_WORKER, str(log)), where) for where in (scheduler, "")]
    for one in both:
        _, errors = one.communicate(timeout=120)
        assert one.returncode == 0, errors
    assert indices(path) == list(range(30))
    assert sorted(map(int, log.read_text().split())) == list(range(30))  # none was done twice, so the work was shared


def test_a_full_disk_loses_nothing(tmp_path, scheduler):
    path, todo = tmp_path / "rows.csv", [fake_run(index) for index in range(4)]
    campaign(todo[:1], path, quiet=True, command=FAKE_WORKER)
    before = path.read_bytes()
    with largest_file(len(before) + 20), pytest.raises(InputError, match="cannot be written: File too large"):
        campaign(todo, path, quiet=True, command=FAKE_WORKER, scheduler=scheduler)
    assert path.read_bytes() == before
    assert campaign(todo, path, quiet=True, command=FAKE_WORKER, scheduler=scheduler) == []
    assert indices(path) == [0, 1, 2, 3]


def test_started_by_hand_a_cluster_grows_and_may_go(tmp_path):
    """The README's commands; the campaign comes first, and the scheduler is killed before its end."""
    path, file, log = tmp_path / "rows.csv", tmp_path / "scheduler.json", tmp_path / "log"
    dask_command = [sys.executable, "-m", "dask"]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    options = ["--port", "0", "--no-dashboard", "--scheduler-file", file]
    scheduler = subprocess.Popen([*dask_command, "scheduler", *options], **quiet)
    wait_until(file.exists)
    address = json.loads(file.read_text())["address"]
    running = start_campaign(path, 20, 1, (*FAKE_WORKER, str(log)), address)
    worker = subprocess.Popen([*dask_command, "worker", address, "--nthreads", "1", "--no-dashboard"], **quiet)
    wait_for_rows(path, 2, running)
    scheduler.kill()
    _, errors = running.communicate(timeout=60)
    assert running.returncode != 0
    assert f"InputError: scheduler: lost the connection to {address}; the rows written so far are whole" in errors
    assert len(read_rows(path)) >= 2
    worker.terminate()
    worker.wait(60)


def test_what_is_missing_is_one_line(tmp_path, monkeypatch, capsys):
    path = tmp_path / "rows.csv"
    command = ["campaign", "--profile", "smoke", "--results", str(path), "--scheduler", "tcp://127.0.0.1:1"]
    assert main([*command, "--jobs", "2"]) == 2
    assert capsys.readouterr().err.startswith("jobs: a cluster does as many runs at a time as its workers have")
    monkeypatch.delitem(sys.modules, "mamttsp.experiments.campaigns.cluster", raising=False)
    monkeypatch.setitem(sys.modules, "distributed", None)
    assert main(command) == 2
    err = capsys.readouterr().err
    assert err.startswith("scheduler: ") and err.endswith("install it with: pip install distributed\n")
    assert err.count("\n") == 1 and not path.exists()


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:1", "nonsense://host", ""])
def test_no_answer_is_one_line(tmp_path, monkeypatch, address):
    from mamttsp.experiments.campaigns import cluster

    monkeypatch.setattr(cluster, "_CONNECT", 1)
    with pytest.raises(InputError, match="scheduler: expected an address such as tcp://host:8786, no answer"):
        campaign([fake_run(0)], tmp_path / "rows.csv", quiet=True, scheduler=address)
