"""Each error: its lines on stderr, and its exit code."""

import errno

import click
import pytest

from evenbreak.cli.kit.said import PROBLEMS_SHOWN, report_error
from evenbreak.errors import AccuracyError, ChainError, DataError, InputError


@pytest.mark.parametrize(
    ("error", "code", "printed"),
    [
        (InputError("p is 2; give less"), 2, "Error: p is 2; give less\n"),
        (DataError(["a.csv:2: x", "a.csv:3: y"]), 3, "Error: a.csv:2: x\nError: a.csv:3: y\n"),
        (ChainError("the state\n'A'"), 1, "Error: the state 'A'\n"),
        (AccuracyError("too stiff"), 1, "Error: too stiff\n"),
        (click.Abort(), 130, "Interrupted.\n"),
        (KeyboardInterrupt(), 130, "Interrupted.\n"),
        (click.UsageError("no"), 2, "Error: no\n"),
        (OSError(errno.ENOSPC, "No space left", "out.csv"), 1, "Error: out.csv: No space left\n"),
        (OSError(errno.EIO, "Input/output error"), 1, "Error: Input/output error\n"),
        (OSError("no line"), 1, "Error: no line\n"),
    ],
)
def test_each_error_has_its_exit_code_and_a_line_for_each_problem(capsys, error, code, printed):
    assert report_error(error) == code
    assert capsys.readouterr() == ("", printed)


def broken_import(cause):
    """Return the error into which an import turns one that is raised inside it."""
    try:
        try:
            raise cause
        except type(cause) as inner:
            raise RuntimeError("Error calling __set_name__ on 'cached_property'") from inner
    except RuntimeError as error:
        return error


def test_an_interrupt_inside_an_import_is_an_interrupt(capsys):
    assert report_error(broken_import(KeyboardInterrupt())) == 130
    assert capsys.readouterr().err == "Interrupted.\n"
    with pytest.raises(RuntimeError, match="cached_property"):  # a bug
        report_error(broken_import(ValueError()))


@pytest.mark.parametrize("error", [OverflowError(34, "out of range"), MemoryError()])
def test_what_the_computer_cannot_do_is_one_line(capsys, error):
    assert report_error(error) == 1
    printed = capsys.readouterr().err
    assert printed.startswith("Error: ")
    assert printed.count("\n") == 1


def test_a_long_list_of_problems_is_cut(capsys):
    problems = [f"a.csv:{line}: x" for line in range(PROBLEMS_SHOWN + 3)]
    assert report_error(DataError(problems)) == 3
    printed = capsys.readouterr().err.splitlines()
    assert printed[:-1] == [f"Error: {problem}" for problem in problems[:PROBLEMS_SHOWN]]
    assert "3 more" in printed[-1]
