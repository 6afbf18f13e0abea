import io
import sys

from evenbreak.cli import progress as module
from evenbreak.cli.progress import Progress


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


def test_a_long_answer_is_counted_and_the_line_wiped_out(monkeypatch):
    told = counted(monkeypatch, Screen(), 0.0).split("\r")
    assert told[1:4] == [f"{count} charts designed so far ..." for count in (1, 2, 3)]
    assert set(told[4]) == {" "}
    assert len(told[4]) == len(told[3])
    assert told[5:] == [""]


def test_a_short_answer_and_a_file_are_told_nothing(monkeypatch):
    assert counted(monkeypatch, Screen(), 60.0) == ""
    assert counted(monkeypatch, io.StringIO(), 0.0) == ""
