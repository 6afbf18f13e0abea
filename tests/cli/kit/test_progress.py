"""A line on a terminal that shows the progress of long work."""

import io
import sys
import time

import click
from click.testing import CliRunner

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit import progress as module
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.progress import Progress, Working
from evenbreak.cli.kit.terminal import say


class Screen(io.StringIO):
    def isatty(self):
        return True


def counted(monkeypatch, stderr, patience):
    monkeypatch.setattr(sys, "stderr", stderr)
    monkeypatch.setattr(module, "PATIENCE", patience)
    monkeypatch.setattr(module, "_PAUSE", 0.0)
    with Progress("charts designed") as progress:
        for count in range(1, 4):
            progress(count)
    return stderr.getvalue()


def test_long_work_is_counted_and_the_line_erased(monkeypatch):
    printed = counted(monkeypatch, Screen(), 0.0).split("\r")
    assert printed[1:4] == [f"{count} charts designed so far ..." for count in (1, 2, 3)]
    assert set(printed[4]) == {" "}
    assert len(printed[4]) == len(printed[3])
    assert printed[5:] == [""]


def test_with_a_known_total_the_time_left_is_shown(monkeypatch):
    screen, clock = Screen(), iter([100.0, 101.0, 110.0, 220.0, 1300.0])
    monkeypatch.setattr(sys, "stderr", screen)
    monkeypatch.setattr(module.time, "monotonic", lambda: next(clock))
    with Progress("seasons") as progress:
        for count in (0, 250, 500, 2000):
            progress(count, 10_000)
    printed = [line.rstrip() for line in screen.getvalue().split("\r")]
    assert printed[1:5] == [
        "0 of 10,000 seasons (0%), time left not yet known ...",
        "250 of 10,000 seasons (2%), about 6 min left ...",
        "500 of 10,000 seasons (5%), about 38 min left ...",
        "2,000 of 10,000 seasons (20%), about 1 h 20 min left ...",
    ]
    assert max(map(len, printed)) <= 80


def test_nothing_is_shown_for_short_work_or_in_a_file(monkeypatch):
    assert counted(monkeypatch, Screen(), 60.0) == ""
    assert counted(monkeypatch, io.StringIO(), 0.0) == ""


def test_long_work_prints_one_plain_line_into_a_file(monkeypatch):
    monkeypatch.setattr(module, "PATIENCE_IN_A_FILE", 0.0)
    assert counted(monkeypatch, io.StringIO(), 0.0) == "1 charts designed so far ...\n"


def waited(monkeypatch, stderr, work):
    monkeypatch.setattr(sys, "stderr", stderr)
    monkeypatch.setattr(sys, "argv", ["evenbreak", "chain", "arcs.csv"])
    monkeypatch.setattr(module, "SILENCE", 0.01)
    with Working():
        work()
    return stderr.getvalue().split("\r")


def test_a_command_that_takes_long_says_so_on_a_terminal_and_erases_the_line(monkeypatch):
    screen = Screen()

    def work():
        while not screen.getvalue():
            time.sleep(0.01)
        say("Wrote a.csv")

    _, line, blank, message, *_ = waited(monkeypatch, screen, work)
    assert line == "Working, 0 s so far; Ctrl-C stops it ..."
    assert blank == " " * len(line)
    assert message.startswith("Wrote a.csv\n")


def test_work_that_ends_soon_counts_by_itself_or_has_no_terminal_says_no_more(monkeypatch):
    assert waited(monkeypatch, Screen(), lambda: None) == [""]
    assert waited(monkeypatch, io.StringIO(), lambda: time.sleep(0.05)) == [""]
    with Progress("steps"):
        assert waited(monkeypatch, Screen(), lambda: time.sleep(0.05)) == [""]


def test_every_answer_is_waited_for(monkeypatch):
    seen = []
    monkeypatch.setattr(Working, "__enter__", lambda working: seen.append(working))
    command = click.command("slow")(faces()(lambda: Answer("Done", [])))
    assert CliRunner().invoke(command).exit_code == 0
    assert len(seen) == 1
