"""`--dask ADDRESS`: what is wrong with a cluster is said in one line, within seconds."""

import operator
import os
import signal
import socket
import subprocess
import sys
import time

import pytest

from evenbreak.cli.kit import cluster as module
from evenbreak.cli.kit.cluster import cluster_at
from evenbreak.errors import InputError, WorkerError
from evenbreak.workers import in_order
from rows import posix

distributed = pytest.importorskip("distributed", reason="the extra evenbreak[dask] is missing")


@pytest.fixture(autouse=True)
def impatient(monkeypatch):
    monkeypatch.setattr(module, "_PATIENCE", 1.0)


@pytest.fixture(scope="module")
def small():
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, dashboard_address=":0", silence_logs=50
    ) as started:
        yield started


def test_a_cluster_is_found_by_its_address(small):
    with cluster_at(small.scheduler_address) as client:
        assert list(in_order(pow, 2, range(5), executor=client)) == [1, 2, 4, 8, 16]


def test_what_the_work_raises_is_said_with_the_address(small):
    with (
        pytest.raises(WorkerError, match=r"tcp://\S+ didn't finish.*ZeroDivisionError"),
        cluster_at(small.scheduler_address) as client,
    ):
        list(in_order(operator.truediv, 1, [1, 0], executor=client))


@pytest.mark.slow
def test_refusals_of_our_own_come_through(small):
    with pytest.raises(InputError, match="jobs"), cluster_at(small.scheduler_address) as client:
        list(in_order(pow, 2, [1], executor=client, jobs=0))


ASK = """
import sys
from evenbreak.cli.kit import cluster
cluster._PATIENCE = 1.0
with cluster.cluster_at(sys.argv[1]):
    pass
"""


@pytest.mark.slow
@pytest.mark.parametrize("listens", [False, True])
def test_a_port_without_a_scheduler(listens):
    """Nobody listens there, or somebody who never answers."""
    with socket.socket() as server:
        server.bind(("127.0.0.1", 0))
        if listens:
            server.listen()
        address = f"tcp://127.0.0.1:{server.getsockname()[1]}"
        # In a process of its own: clients that never connected haunt the next ones.
        asked = subprocess.run(
            [sys.executable, "-c", ASK, address], capture_output=True, text=True, timeout=30
        )
    assert asked.returncode == 1
    assert f"WorkerError: no dask scheduler answers at '{address}'" in asked.stderr


@pytest.mark.slow
def test_a_cluster_without_workers():
    with (
        distributed.LocalCluster(n_workers=0, dashboard_address=":0", silence_logs=50) as empty,
        pytest.raises(WorkerError, match="has no worker"),
        cluster_at(empty.scheduler_address),
    ):
        pass


CLUSTER = """
import time, distributed
if __name__ == "__main__":
    cluster = distributed.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=":0")
    print(cluster.scheduler_address, flush=True)
    time.sleep(60)
"""


@pytest.mark.slow
@posix
def test_a_cluster_that_is_gone(tmp_path, capfd):
    script = tmp_path / "cluster.py"
    script.write_text(CLUSTER, encoding="utf-8")
    with subprocess.Popen(
        [sys.executable, str(script)],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        start_new_session=True,
    ) as doomed:
        assert doomed.stdout is not None
        address = doomed.stdout.readline().strip()
        with pytest.raises(WorkerError, match="didn't finish"):
            work_until_killed(address, doomed.pid)
    assert "Traceback" not in capfd.readouterr().err


def work_until_killed(address, group):
    with cluster_at(address) as client:
        results = in_order(operator.call, time.sleep, [0.0, 30.0], executor=client)
        next(results)
        os.killpg(group, signal.SIGKILL)
        next(results)


@pytest.mark.slow
def test_dask_that_is_not_installed(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InputError, match=r"evenbreak\[dask\]"), cluster_at("tcp://127.0.0.1:1"):
        pass
