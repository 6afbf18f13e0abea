"""The answer goes to stdout, everything else to stderr."""

import io

import pytest

from evenbreak.cli.kit.terminal import say, to_terminal, write


def test_a_message_stays_on_its_line(capsys: pytest.CaptureFixture[str]) -> None:
    say("No such file: a\nb\x1b.csv")
    assert capsys.readouterr() == ("", "No such file: a\\nb\\x1b.csv\n")


def test_a_message_is_wrapped_on_a_terminal(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    message = "Wrote " + ", ".join(f"table_{k}.csv" for k in range(20)) + " to /" + "x" * 100
    say(message)
    assert capsys.readouterr().err == f"{message}\n"
    monkeypatch.setattr("sys.stderr.isatty", lambda: True, raising=False)
    say(message)
    printed = capsys.readouterr().err
    assert printed.split() == message.split()
    assert all(len(line) <= 80 for line in printed.splitlines()[:-1])
    assert len(printed.splitlines()) > 2


def test_letters_that_the_terminal_lacks_are_replaced(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for encoding, written in (("utf-8", "Ærø 7:5\n".encode()), ("ascii", b"?r? 7:5\n")):
        terminal = io.TextIOWrapper(io.BytesIO(), encoding=encoding)
        monkeypatch.setattr("sys.stdout", terminal)
        write("Ærø 7:5\n")
        assert terminal.buffer.getvalue() == written  # type: ignore[attr-defined]


def test_whether_the_output_is_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    assert not to_terminal()
    monkeypatch.setattr("sys.stdout.isatty", lambda: True, raising=False)
    assert to_terminal()
    monkeypatch.setattr("sys.stdout", None)
    assert not to_terminal()
