"""A dask cluster does the work of a lost worker again, and what cannot be is said at once."""

import math
import operator
import os
import signal
import socket
import subprocess
import sys
import time

import numpy as np
import pytest

distributed = pytest.importorskip("distributed", reason="the extra evenbreak[dask] is not there")

from evenbreak.errors import InputError, WorkerError  # noqa: E402
from evenbreak.league import (  # noqa: E402
    LeaguePlayers,
    RandomPairing,
    Season,
    on_dask,
    simulate,
)
from evenbreak.league.executors import in_order  # noqa: E402
from evenbreak.league.on_dask import DaskExecutor  # noqa: E402


@pytest.fixture(scope="module")
def cluster():
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=":0", silence_logs=50
    ) as started:
        yield started


def test_results_are_those_of_this_process(cluster):
    with DaskExecutor(cluster.scheduler_address) as executor:
        assert executor.workers == 2
        results = list(in_order(math.comb, 30, range(31), executor=executor))
    assert results == [math.comb(30, n) for n in range(31)]


def test_a_client_of_the_callers_stays_open(cluster):
    with distributed.Client(cluster, set_as_default=False) as client:
        with DaskExecutor(client) as executor:
            assert list(in_order(pow, 2, range(5), executor=executor)) == [1, 2, 4, 8, 16]
        assert client.status == "running"
        assert list(in_order(pow, 2, range(3), executor=client.get_executor())) == [1, 2, 4]


def test_what_is_shared_is_sent_once_however_large(cluster):
    sent = bytes(30_000_000)  # of which dask would warn
    with DaskExecutor(cluster.scheduler_address) as executor:
        assert list(in_order(operator.getitem, sent, range(20), executor=executor)) == [0] * 20


def test_an_error_of_the_task_comes_through(cluster):
    with DaskExecutor(cluster.scheduler_address) as executor, pytest.raises(ZeroDivisionError):
        list(in_order(operator.truediv, 1, [1, 0], executor=executor))


def test_work_of_a_killed_worker_is_done_again(cluster):
    with DaskExecutor(cluster.scheduler_address) as executor:
        results = in_order(slow_square, 0.05, range(30), executor=executor)
        first = next(results)
        with distributed.Client(cluster, set_as_default=False) as client:
            pids = sorted(client.run(os.getpid).values())
        os.kill(pids[0], signal.SIGKILL)
        assert [first, *results] == [n * n for n in range(30)]


def test_a_piece_that_kills_its_workers_is_told(cluster):
    with (
        DaskExecutor(cluster.scheduler_address) as executor,
        pytest.raises(WorkerError, match="one piece of work ended several workers"),
    ):
        list(in_order(operator.call, os._exit, [1], executor=executor))


def test_a_league_comes_to_the_same_bytes_though_a_worker_is_killed(cluster):
    season = Season(LeaguePlayers.of(range(40, 104)), "npl", schedule=RandomPairing(), weeks=30)
    alone = simulate(season, replicas=10_000, seed=5)
    killed = []

    def kill_one(done, total):
        if 0 < done < total and not killed:
            killed.append(cluster.workers[0].pid)
            os.kill(killed[0], signal.SIGKILL)

    with DaskExecutor(cluster.scheduler_address) as executor:
        shared = simulate(season, replicas=10_000, seed=5, executor=executor, progress=kill_one)
    assert killed
    assert as_bytes(shared) == as_bytes(alone)


def as_bytes(tally):
    columns = vars(tally).items()
    return {name: None if x is None else np.asarray(x).tobytes() for name, x in columns}


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@pytest.mark.parametrize(
    "address", ["tcp://127.0.0.1:{port}", "nowhere.invalid:8786", "http://127.0.0.1:{port}", ""]
)
def test_a_wrong_address_is_said_within_seconds(address, monkeypatch, caplog, capfd):
    monkeypatch.setattr(on_dask, "_PATIENCE", 1.0)
    address = address.format(port=free_port())
    with pytest.raises(WorkerError, match=rf"no dask scheduler answers at '{address}'; give"):
        DaskExecutor(address)
    assert caplog.text == ""
    assert "Traceback" not in capfd.readouterr().err


def test_what_listens_but_is_no_scheduler_is_said_too(monkeypatch):
    monkeypatch.setattr(on_dask, "_PATIENCE", 1.0)
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
        with pytest.raises(WorkerError, match="no dask scheduler answers"):
            DaskExecutor(f"tcp://127.0.0.1:{port}")


def test_a_cluster_without_workers_is_said(monkeypatch):
    monkeypatch.setattr(on_dask, "_PATIENCE", 0.5)
    with (
        distributed.LocalCluster(n_workers=0, dashboard_address=":0", silence_logs=50) as empty,
        pytest.raises(WorkerError, match="has no worker; start"),
    ):
        DaskExecutor(empty.scheduler_address)


def test_a_cluster_that_lost_all_its_workers_is_said(monkeypatch):
    monkeypatch.setattr(on_dask, "_ABSENCE", 0.5)
    with (
        distributed.LocalCluster(
            n_workers=1, threads_per_worker=1, dashboard_address=":0", silence_logs=50
        ) as doomed,
        DaskExecutor(doomed.scheduler_address) as executor,
    ):
        doomed.scale(0)
        while doomed.scheduler.workers:
            time.sleep(0.05)
        with pytest.raises(WorkerError, match="no worker in reach"):
            list(in_order(pow, 2, [1], executor=executor))


CLUSTER = """
import time, distributed
if __name__ == "__main__":
    cluster = distributed.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=":0")
    print(cluster.scheduler_address, flush=True)
    time.sleep(60)
"""


def test_a_cluster_that_is_gone_is_said(tmp_path, monkeypatch, capfd):
    monkeypatch.setattr(on_dask, "_ABSENCE", 1.0)
    script = tmp_path / "cluster.py"
    script.write_text(CLUSTER, encoding="utf-8")
    with (
        subprocess.Popen(
            [sys.executable, str(script)],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            start_new_session=True,
        ) as doomed,
        DaskExecutor(doomed.stdout.readline().strip()) as executor,
    ):
        results = in_order(operator.call, time.sleep, [0.0, 30.0], executor=executor)
        next(results)  # given out first, done first
        os.killpg(doomed.pid, signal.SIGKILL)
        with pytest.raises(WorkerError, match=r"no worker in reach|is gone"):
            next(results)
    assert capfd.readouterr().err == ""


def test_dask_that_is_not_installed_is_said(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InputError, match=r"not installed; install it with.*evenbreak\[dask\]"):
        DaskExecutor("tcp://127.0.0.1:1")


def slow_square(pause, n):
    time.sleep(pause)
    return n * n
