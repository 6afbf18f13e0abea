"""Simulating with more workers: the same files, a clean end on Ctrl-C, wrong addresses said."""

import contextlib
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


def ended(play):
    """Return what a run told on stderr once it has ended; nobody of it is left if it does not."""
    try:
        return play.communicate(timeout=30)[1]
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(play.pid, signal.SIGKILL)


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
@pytest.mark.parametrize(("jobs", "after"), [("1", 0.5), ("2", 0.0), ("2", 0.3), ("2", 2.5)])
def test_ctrl_c_ends_with_130_and_writes_nothing(roster, tmp_path, jobs, after):
    """Whether the workers are not there yet, are starting, or at work."""
    out = tmp_path / "out"
    play = started(roster, "--replicas", "10000000", "--jobs", jobs, "--out", str(out))
    assert play.stderr is not None
    assert "6,000,000,000 matches" in play.stderr.readline()  # the roster is read
    time.sleep(after)
    os.killpg(play.pid, signal.SIGINT)  # to the workers too, as a terminal sends it
    told = ended(play)
    assert play.returncode == 130
    assert told.strip() == "Interrupted."
    assert not out.exists()


@pytest.mark.skipif(not hasattr(os, "killpg"), reason="a terminal's Ctrl-C is POSIX here")
def test_nobody_outlives_an_interrupt(roster, tmp_path):
    play = started(roster, "--replicas", "10000000", "--jobs", "2", "--out", str(tmp_path / "out"))
    assert play.stderr is not None
    play.stderr.readline()
    time.sleep(1.5)
    os.killpg(play.pid, signal.SIGINT)
    play.communicate(timeout=30)
    begun = time.monotonic()
    while time.monotonic() - begun < 20 and anybody_of_group(play.pid):
        time.sleep(0.1)
    alone = not anybody_of_group(play.pid)
    if not alone:
        os.killpg(play.pid, signal.SIGKILL)
    assert alone


def test_a_wrong_address_is_one_line_and_nothing_is_written(roster, tmp_path):
    pytest.importorskip("distributed", reason="the extra evenbreak[dask] is not there")
    out = tmp_path / "out"
    play = started(roster, "--dask", "localhost", "--out", str(out))
    _, told = play.communicate(timeout=60)
    assert play.returncode == 1
    assert told.splitlines()[-1].startswith("Error: no dask scheduler answers at 'localhost'; give")
    assert "Traceback" not in told
    assert not out.exists()
