"""Simulating with more workers: a clean end on Ctrl-C, wrong addresses said."""

import os
import signal
import subprocess
import sys
import time

import pytest

from rows import posix

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


def nobody_left_of(group):
    """Whether all processes of a group end within 20 seconds; those that do not are killed."""
    deadline = time.monotonic() + 20
    try:
        while time.monotonic() < deadline:
            os.killpg(group, 0)
            time.sleep(0.05)
        os.killpg(group, signal.SIGKILL)
    except ProcessLookupError:
        return True
    return False


@pytest.mark.slow
@posix
@pytest.mark.parametrize(("jobs", "after"), [("1", 0.5), ("2", 0.0), ("2", 0.8)])
def test_ctrl_c_ends_with_130_writes_nothing_and_nobody_outlives_it(roster, tmp_path, jobs, after):
    """Whether the workers are not there yet, are starting, or at work."""
    out = tmp_path / "out"
    play = started(roster, "--replicas", "10000000", "--jobs", jobs, "--out", str(out))
    assert play.stderr is not None
    assert "6,000,000,000 matches" in play.stderr.readline()  # the roster is read
    time.sleep(after)
    os.killpg(play.pid, signal.SIGINT)  # to the workers too, as a terminal sends it
    _, told = play.communicate(timeout=30)
    assert play.returncode == 130
    assert told.strip() == "Interrupted."
    assert not out.exists()
    assert nobody_left_of(play.pid)


@pytest.mark.slow
def test_a_wrong_address_is_one_line_and_nothing_is_written(roster, tmp_path):
    pytest.importorskip("distributed", reason="the extra evenbreak[dask] isn't there")
    out = tmp_path / "out"
    play = started(roster, "--dask", "localhost", "--out", str(out))
    _, told = play.communicate(timeout=60)
    assert play.returncode == 1
    assert told.splitlines()[-1].startswith("Error: no dask scheduler answers at 'localhost'. Give")
    assert "Traceback" not in told
    assert not out.exists()
