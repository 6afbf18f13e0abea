"""Work in pieces gives the same results, in the same order, whoever does it."""

import math
import operator
import os
import shutil
import signal
import subprocess
import sys
import time
from concurrent.futures import Future, ThreadPoolExecutor
from itertools import count, islice

import numpy as np
import pytest

from evenbreak.errors import InputError, WorkerError
from evenbreak.league import LeaguePlayers, RandomPairing, Season, simulate
from evenbreak.workers import in_order
from rows import posix


class Backwards(ThreadPoolExecutor):
    """Does the last of the pieces that it was given first."""

    def __init__(self, window):
        self.given, self.window = [], window

    def submit(self, fn, /, *args):
        future = Future()
        self.given.append((future, fn, args))
        if len(self.given) % self.window == 0:
            for future_, fn_, args_ in reversed(self.given[-self.window :]):
                future_.set_result(fn_(*args_))
        return future


def test_results_come_in_the_order_of_the_pieces_whoever_is_first():
    window = 2 * (os.cpu_count() or 1)
    results = in_order(pow, 3, range(window), executor=Backwards(window))
    assert list(results) == [3**n for n in range(window)]


@pytest.mark.parametrize("jobs", [1, 2])
def test_the_number_of_processes_does_not_matter(jobs):
    assert list(in_order(math.comb, 30, range(31), jobs=jobs)) == [
        math.comb(30, n) for n in range(31)
    ]


def test_any_executor_will_do():
    with ThreadPoolExecutor(3) as threads:
        assert list(in_order(pow, 2, range(9), executor=threads)) == [2**n for n in range(9)]
        assert threads.submit(pow, 2, 3).result() == 8  # it is still its owner's


def test_no_pieces_no_results():
    with ThreadPoolExecutor(1) as threads:
        assert list(in_order(pow, 2, [], executor=threads)) == []


def test_pieces_are_taken_only_as_they_are_needed():
    taken = []

    def pieces():
        for n in count():
            taken.append(n)
            yield n

    with ThreadPoolExecutor(2) as threads:
        results = in_order(pow, 2, pieces(), executor=threads)
        assert list(islice(results, 5)) == [1, 2, 4, 8, 16]
        results.close()
    assert len(taken) <= 5 + 2 * (os.cpu_count() or 1)


def test_an_error_of_the_task_comes_through():
    with pytest.raises(ZeroDivisionError):
        list(in_order(operator.truediv, 1, [1, 0, 1], jobs=2))


def test_a_killed_worker_is_one_error():
    with pytest.raises(WorkerError, match="fewer jobs"):
        list(in_order(operator.call, os._exit, [1] * 4, jobs=2))


IN_A_FOLDER = """
import sys
sys.path = [place for place in sys.path if place]
from evenbreak.workers import in_order
if __name__ == "__main__":
    print(list(in_order(pow, 2, range(5), jobs=2)))
"""


def test_workers_run_no_code_of_the_working_folder(tmp_path):
    (tmp_path / "scripts").mkdir()
    script = tmp_path / "scripts" / "powers.py"
    script.write_text(IN_A_FOLDER, encoding="utf-8")
    for name in ("pickle", "struct", "signal", "threading"):
        (tmp_path / f"{name}.py").write_text("print('run')\n", encoding="utf-8")
    done = subprocess.run(
        [sys.executable, str(script)], cwd=tmp_path, capture_output=True, text=True
    )
    assert (done.stdout, done.stderr) == ("[1, 2, 4, 8, 16]\n", "")


@pytest.mark.parametrize("jobs", [0, -1, 1.5, "two"])
def test_jobs_are_counted_from_one(jobs):
    with pytest.raises(InputError, match="jobs must"):
        list(in_order(pow, 2, [1], jobs=jobs))


SLEEPS = """
import operator, time
from evenbreak.workers import in_order
if __name__ == "__main__":
    print("begun", flush=True)
    list(in_order(operator.call, time.sleep, [0.5] * 400, jobs=2))
"""


def children_of(pid):
    listed = subprocess.run(
        ["ps", "-o", "pid=", "--ppid", str(pid)], capture_output=True, text=True
    )
    return [int(line) for line in listed.stdout.split()]


def alive(pid):
    state = subprocess.run(["ps", "-o", "stat=", "-p", str(pid)], capture_output=True, text=True)
    return bool(state.stdout.strip()) and not state.stdout.startswith("Z")


@pytest.mark.slow_after(2)
@pytest.mark.skipif(not shutil.which("ps"), reason="who is alive is asked of ps")
@pytest.mark.parametrize(("sign", "pause"), [("SIGINT", 0.0), ("SIGINT", 1.5), ("SIGKILL", 1.5)])
def test_workers_end_with_their_parent(tmp_path, sign, pause):
    """A bare pool fails at each of these: tracebacks of workers that start, workers left over."""
    script = tmp_path / "sleeps.py"
    script.write_text(SLEEPS, encoding="utf-8")
    parent = subprocess.Popen(
        [sys.executable, str(script)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    assert parent.stdout is not None
    parent.stdout.readline()
    time.sleep(pause)
    children = children_of(parent.pid)
    assert len(children) >= (2 if pause else 0)
    if sign == "SIGINT":
        os.killpg(parent.pid, signal.SIGINT)  # as a terminal does: to the workers too
    else:
        os.kill(parent.pid, signal.SIGKILL)
    _, told = parent.communicate(timeout=20)
    if sign == "SIGINT":
        assert told.count("Traceback") == 1  # the parent's own
        assert "KeyboardInterrupt" in told
    deadline = time.monotonic() + 10
    while any(map(alive, children)) and time.monotonic() < deadline:
        time.sleep(0.1)
    assert [pid for pid in children if alive(pid)] == []


COMPUTES = """
import pathlib, sys, time
from evenbreak.workers import in_order

def begin(folder, number):
    pathlib.Path(folder, str(number)).touch()
    time.sleep(60)

if __name__ == "__main__":
    list(in_order(begin, sys.argv[1], range(40), jobs=2))
"""


@posix
def test_ctrl_c_does_not_wait_for_pieces_under_way(tmp_path):
    script, begun = tmp_path / "computes.py", tmp_path / "begun"
    script.write_text(COMPUTES, encoding="utf-8")
    begun.mkdir()
    parent = subprocess.Popen(
        [sys.executable, str(script), str(begun)], stderr=subprocess.DEVNULL, start_new_session=True
    )
    deadline = time.monotonic() + 60
    while len(list(begun.iterdir())) < 2 and time.monotonic() < deadline:
        time.sleep(0.1)
    os.killpg(parent.pid, signal.SIGINT)
    assert parent.wait(timeout=30)


@pytest.fixture(scope="module")
def cluster():
    distributed = pytest.importorskip("distributed", reason="the extra evenbreak[dask] is missing")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=":0", silence_logs=50
    ) as started:
        yield started


@pytest.fixture
def client(cluster):
    from distributed import Client

    with Client(cluster, set_as_default=False) as connected:
        yield connected


def test_a_cluster_works_and_stays_open(client):
    assert list(in_order(math.comb, 30, range(31), executor=client)) == [
        math.comb(30, n) for n in range(31)
    ]
    assert list(in_order(pow, 2, range(3), executor=client.get_executor())) == [1, 2, 4]
    assert client.status == "running"


@pytest.mark.slow
def test_what_is_shared_may_be_large(client, recwarn):
    sent = bytes(30_000_000)  # of which dask would warn
    assert list(in_order(operator.getitem, sent, range(20), executor=client)) == [0] * 20
    assert not recwarn.list


@pytest.mark.slow
def test_an_error_of_the_task_comes_through_a_cluster(client):
    with pytest.raises(ZeroDivisionError):
        list(in_order(operator.truediv, 1, [1, 0], executor=client))


@pytest.mark.slow
def test_a_league_comes_to_the_same_bytes_although_a_worker_is_killed(cluster, client):
    season = Season(LeaguePlayers.of(range(40, 104)), "npl", schedule=RandomPairing(), weeks=30)
    alone = simulate(season, replicas=4_000, seed=5)
    killed = []

    def kill_one(done, total):
        if 0 < done < total and not killed:
            killed.append(cluster.workers[0].pid)
            os.kill(killed[0], signal.SIGKILL)

    shared = simulate(season, replicas=4_000, seed=5, executor=client, progress=kill_one)
    assert killed
    assert as_bytes(shared) == as_bytes(alone)


def as_bytes(tally):
    columns = vars(tally).items()
    return {name: None if x is None else np.asarray(x).tobytes() for name, x in columns}
