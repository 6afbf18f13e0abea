"""A line on a terminal that shows the progress of long work."""

import io
import sys

from evenbreak.cli.kit import progress as module
from evenbreak.cli.kit.progress import Progress


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
