"""Simulating with more workers: the same files, a clean end on Ctrl-C, wrong addresses said."""

import os
import signal
import subprocess
import sys
import time

import pytest

ROSTER = "player,rating,standard_error\n" + "".join(f"Player {n},{40 + n},5\n" for n in range(40))


@pytest.fixture
def roster(tmp_path):
    path = tmp_path / "roster.csv"
    path.write_text(ROSTER, encoding="utf-8")
    return path


def started(roster, *options):
    return subprocess.Popen(
        [sys.executable, "-m", "evenbreak", "simulate", str(roster), *options],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def anybody_of_group(group):
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True


def test_two_jobs_write_the_same_files(roster, tmp_path):
    written = []
    for jobs in ("1", "2"):
        out = tmp_path / f"jobs_{jobs}"
        play = started(
            roster, "--replicas", "50", "--weeks", "4", "--jobs", jobs, "--out", str(out)
        )
        printed, _ = play.communicate(timeout=60)
        assert play.returncode == 0
        written.append((printed, {path.name: path.read_bytes() for path in out.iterdir()}))
    assert written[0] == written[1]


@pytest.mark.skipif(not hasattr(os, "killpg"), reason="a terminal's Ctrl-C is POSIX here")
@pytest.mark.parametrize("jobs", ["1", "2"])
def test_ctrl_c_ends_with_130_and_writes_nothing(roster, tmp_path, jobs):
    out = tmp_path / "out"
    play = started(roster, "--replicas", "10000000", "--jobs", jobs, "--out", str(out))
    assert play.stderr is not None
    play.stderr.readline()  # the roster is read
    time.sleep(2.5)
    os.killpg(play.pid, signal.SIGINT)  # to the workers too, as a terminal sends it
    begun = time.monotonic()
    _, told = play.communicate(timeout=30)
    assert play.returncode == 130
    assert told.strip() == "Interrupted."
    assert time.monotonic() - begun < 20
    assert not out.exists()
    while time.monotonic() - begun < 20 and anybody_of_group(play.pid):
        time.sleep(0.1)
    assert not anybody_of_group(play.pid)


def test_a_wrong_address_is_one_line_and_nothing_is_written(roster, tmp_path):
    pytest.importorskip("distributed", reason="the extra evenbreak[dask] is not there")
    out = tmp_path / "out"
    play = started(roster, "--dask", "localhost", "--out", str(out))
    _, told = play.communicate(timeout=60)
    assert play.returncode == 1
    assert told.splitlines()[-1].startswith("Error: no dask scheduler answers at 'localhost'; give")
    assert "Traceback" not in told
    assert not out.exists()
