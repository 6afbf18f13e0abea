"""A bar on a terminal that shows the progress of long work."""

import io
import re
import subprocess
import sys
import time
from itertools import pairwise

import click
import pytest
from click.testing import CliRunner

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit import progress as module
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.progress import Progress, Working
from evenbreak.cli.kit.terminal import say

ERASED = "\x1b[?25h\r\x1b[1A\x1b[2K"
"""The cursor comes back, to the start of an empty line."""


class Screen(io.StringIO):
    def isatty(self):
        return True


@pytest.fixture(autouse=True)
def can_move_its_cursor(monkeypatch):
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setenv("NO_COLOR", "1")


def counted(monkeypatch, stderr, patience):
    monkeypatch.setattr(sys, "stderr", stderr)
    monkeypatch.setattr(module, "PATIENCE", patience)
    with Progress("charts designed") as progress:
        for count in range(1, 4):
            progress(count)
            time.sleep(0.15)
    return stderr.getvalue()


def lines(printed):
    """Return what stood on the line of the bar, one state after the other."""
    return [line for line in re.sub(r"\x1b\[\S*?[lhKA]", "", printed).split("\r") if line.strip()]


@pytest.mark.slow
def test_long_work_is_counted_and_the_bar_erased(monkeypatch):
    printed = counted(monkeypatch, Screen(), 0.0)
    states = lines(printed)
    assert "3 charts designed so far" in states[-1]
    assert all(state.rstrip().endswith("0:00:00") for state in states)
    assert printed.endswith(ERASED)


def test_with_a_known_total_the_time_left_is_shown_in_one_line(monkeypatch):
    screen, clock = Screen(), iter([100.0, 101.0, 110.0, 220.0, 1300.0])
    shown = []
    monkeypatch.setattr(sys, "stderr", screen)
    monkeypatch.setattr(module.time, "monotonic", lambda: next(clock))
    monkeypatch.setattr(module, "_show", lambda _, *what: shown.append(what))
    with Progress("seasons") as progress:
        for count in (0, 250, 500, 2000):
            progress(count, 10_000)
    assert [line for line, *_ in shown] == [
        "0 of 10,000 seasons (0%), time left not yet known",
        "250 of 10,000 seasons (2%), about 6 min left",
        "500 of 10,000 seasons (5%), about 38 min left",
        "2,000 of 10,000 seasons (20%), about 1 h 20 min left",
    ]
    assert shown[-1][1:] == (200, 1_000)


def test_the_bar_is_as_long_as_what_is_done_and_fits_a_terminal(monkeypatch):
    screen = Screen()
    monkeypatch.setattr(sys, "stderr", screen)
    monkeypatch.setattr(module, "PATIENCE", 0.0)
    with Progress("seasons") as progress:
        progress(5_000, 10_000)
        time.sleep(0.15)
    assert any(state.startswith("━" * 8 + " " * 8) for state in lines(screen.getvalue()))
    assert max(map(len, lines(screen.getvalue()))) <= 80


@pytest.mark.slow
def test_nothing_is_shown_for_short_work_or_in_a_file(monkeypatch):
    assert counted(monkeypatch, Screen(), 60.0) == ""
    assert counted(monkeypatch, io.StringIO(), 0.0) == ""


class Clock:
    """A clock that the work moves."""

    def __init__(self, monkeypatch):
        self.seconds = 1000.0
        monkeypatch.setattr(module.time, "monotonic", lambda: self.seconds)


def long_work(monkeypatch, hours=0.1):
    """Return the lines about work of 400 dates, the last of which take longest, by their time."""
    screen, clock = io.StringIO(), Clock(monkeypatch)
    monkeypatch.setattr(sys, "stderr", screen)
    said = []
    with Progress("dates") as progress:
        for date in range(1, 401):
            part = (date / 400) ** 2
            clock.seconds = 1000.0 + 3600.0 * hours * part
            progress(date, 400, part)
            if len(new := screen.getvalue().splitlines()) > len(said):
                said.append((clock.seconds - 1000.0, new[-1]))
    return said


def test_a_file_has_a_line_after_ten_seconds_and_then_every_thirty(monkeypatch):
    times = [seconds for seconds, _ in long_work(monkeypatch)]
    assert 10.0 <= times[0] < 12.0
    assert all(30.0 <= later - earlier < 35.0 for earlier, later in pairwise(times))
    assert times[-1] > 320.0


def test_a_day_of_work_fills_no_file(monkeypatch):
    times = [seconds for seconds, _ in long_work(monkeypatch, hours=24.0)]
    assert len(times) < 90
    assert 3600.0 * 24.0 - times[-1] < 3600.0 * 3.0


def test_the_time_left_is_that_of_the_work_and_not_of_the_dates(monkeypatch):
    """By the dates alone the first lines would say half of what is left, or less."""
    for seconds, line in long_work(monkeypatch):
        minutes, left = re.search(r"about (?:(\d+) min|(\d+) s) left", line).groups()
        said = 60.0 * float(minutes) if minutes else float(left)
        assert abs(said - (360.0 - seconds)) <= 30.0, line


def test_the_line_says_how_many_and_how_much_of_the_work(monkeypatch):
    assert long_work(monkeypatch)[0][1] == (
        "67 of 400 dates (2% of the work), about 6 min left ..."
    )


@pytest.mark.slow
@pytest.mark.parametrize("stderr", [io.StringIO(), Screen()], ids=["file", "dumb terminal"])
def test_long_work_prints_a_plain_line_where_there_is_no_bar(monkeypatch, stderr):
    monkeypatch.setenv("TERM", "dumb")
    monkeypatch.setattr(module, "PATIENCE_IN_A_FILE", 0.0)
    assert counted(monkeypatch, stderr, 0.0) == "1 charts designed so far ...\n"


def waited(monkeypatch, stderr, work):
    monkeypatch.setattr(sys, "stderr", stderr)
    monkeypatch.setattr(sys, "argv", ["evenbreak", "chain", "arcs.csv"])
    monkeypatch.setattr(module, "SILENCE", 0.01)
    with Working():
        work()
    return stderr.getvalue()


def test_a_command_that_takes_long_says_so_on_a_terminal_and_erases_the_bar(monkeypatch):
    screen = Screen()

    def work():
        while "Ctrl-C stops it" not in screen.getvalue():
            time.sleep(0.01)
        say("Wrote a.csv")

    working, message = waited(monkeypatch, screen, work).split(ERASED)
    assert "Working; Ctrl-C stops it 0:00:00" in working
    assert message == "Wrote a.csv\n"


def test_work_that_ends_soon_counts_by_itself_or_has_no_terminal_says_no_more(monkeypatch):
    assert waited(monkeypatch, Screen(), lambda: None) == ""
    assert waited(monkeypatch, io.StringIO(), lambda: time.sleep(0.05)) == ""
    with Progress("steps"):
        assert waited(monkeypatch, Screen(), lambda: time.sleep(0.05)) == ""


def test_every_answer_is_waited_for(monkeypatch):
    seen = []
    monkeypatch.setattr(Working, "__enter__", lambda working: seen.append(working))
    monkeypatch.setattr(Working, "__exit__", lambda *_: None)
    command = click.command("slow")(faces()(lambda: Answer("Done", [])))
    assert CliRunner().invoke(command).exit_code == 0
    assert len(seen) == 1


def test_a_bar_is_loaded_only_when_it_is_shown():
    code = (
        "import sys\n"
        "from evenbreak.cli.kit.progress import Progress, Working\n"
        "with Working(), Progress('seasons') as progress:\n"
        "    progress(1, 2)\n"
        "print([name for name in sys.modules if name.startswith('rich')])\n"
    )
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ended.stdout == "[]\n"
