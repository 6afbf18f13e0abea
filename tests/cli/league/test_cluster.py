"""`--dask ADDRESS`: what is wrong with a cluster is said in one line, within seconds."""

import operator
import os
import signal
import socket
import subprocess
import sys
import time

import pytest

from evenbreak.cli.league import cluster as module
from evenbreak.cli.league.cluster import cluster_at
from evenbreak.errors import InputError, WorkerError
from evenbreak.league.workers import in_order

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
        pytest.raises(WorkerError, match=r"tcp://\S+ did not finish.*ZeroDivisionError"),
        cluster_at(small.scheduler_address) as client,
    ):
        list(in_order(operator.truediv, 1, [1, 0], executor=client))


def test_refusals_of_our_own_come_through(small):
    with pytest.raises(InputError, match="jobs"), cluster_at(small.scheduler_address) as client:
        list(in_order(pow, 2, [1], executor=client, jobs=0))


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:{port}", "http://127.0.0.1:{port}", ""])
def test_an_address_without_a_scheduler(address, caplog, capfd):
    address = address.format(port=free_port())
    with pytest.raises(WorkerError, match=f"'{address}'"), cluster_at(address):
        pass
    assert caplog.text == ""
    assert "Traceback" not in capfd.readouterr().err


def test_a_port_that_accepts_and_never_answers():
    with socket.create_server(("127.0.0.1", 0)) as server:
        address = f"tcp://127.0.0.1:{server.getsockname()[1]}"
        with pytest.raises(WorkerError, match=address), cluster_at(address):
            pass


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
        with (
            pytest.raises(WorkerError, match="did not finish"),
            distributed_timeouts(),
            cluster_at(doomed.stdout.readline().strip()) as client,
        ):
            results = in_order(operator.call, time.sleep, [0.0, 30.0], executor=client)
            next(results)
            os.killpg(doomed.pid, signal.SIGKILL)
            next(results)
    assert "Traceback" not in capfd.readouterr().err


def distributed_timeouts():
    import dask

    return dask.config.set({"distributed.comm.timeouts.connect": "1s"})


def test_dask_that_is_not_installed(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InputError, match=r"evenbreak\[dask\]"), cluster_at("tcp://127.0.0.1:1"):
        pass
