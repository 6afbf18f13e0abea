"""How the terminal says a sentence, refuses wrong usage, and reports an error.

Parameters are options, and files have their whole path. An error is one line on stderr for each
problem, and an exit code: 0 done, 1 failed, 2 wrong usage, 3 bad data, 130 interrupted.
"""

import errno
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import cache
from typing import Any, NoReturn

import click

from evenbreak.cli.interrupts import INTERRUPTED
from evenbreak.errors import DataError, EvenbreakError, InputError
from evenbreak.words import PYTHON, Face, in_face, say

PROBLEMS_SHOWN = 20
NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
FAILED, USAGE, BAD_DATA = 1, 2, 3

_running: list[click.Command] = []
_file: list[str] = []


def runs(command: click.Command) -> None:
    """Keep which command runs: a sentence calls a parameter by its option there."""
    _running[:] = [command]


def works_on(file: str | None) -> None:
    """Keep which file of a tournament was named; None: the usual one."""
    _file[:] = [] if file is None else [file]


def _typed(name: str, words: Sequence[str]) -> str:
    """Return a command as it is typed, with the file of the tournament if one was named."""
    if _file and name.startswith("tournament "):
        option = "--out" if name.endswith((" new", " import")) else "--file"
        words = [*words, option, *_file]
    return PYTHON.command(name, words)


def _spelled(name: str) -> str:
    """Return the option of the command that runs for a parameter; its name if there is none."""
    for param in _running[0].params if _running else ():
        if param.name == name and isinstance(param, click.Option):
            return max(param.opts, key=len)
    return name


@cache
def terminal() -> Face:
    """Return how the terminal says what the command that runs answers."""
    from evenbreak.files.catalogs import face_in

    return replace(face_in("en"), parameter=_spelled, command=_typed)


def said(text: str, spelled: Callable[[str], str] | None = None) -> str:
    """Return a text as the terminal says it; `spelled` returns the option of a parameter.

    >>> from evenbreak.words import Parameter, say
    >>> said(say("{scale} must be above 0", scale=Parameter("scale")), lambda name: f"--{name}")
    '--scale must be above 0'
    """
    face = terminal() if spelled is None else replace(terminal(), parameter=spelled)
    shown: str = in_face(text, face)
    return shown


def number_of(text: str) -> float:
    """Return the number that a text means; -0 is 0.

    >>> number_of("1.5"), number_of("-0")
    (1.5, 0.0)
    """
    return float(text) + 0.0


def refuse(template: str, /, **values: Any) -> NoReturn:
    """End the command with exit code 2; the message says how to correct it, as errors do."""
    message = said(say(template, **values) if values else template)
    raise click.UsageError(message, ctx=click.get_current_context(silent=True))


def report_error(error: BaseException) -> int:
    """Print what went wrong on stderr, one line for each problem, and return the exit code.

    An error that is a bug in this program is raised again.
    """
    match error:
        case click.ClickException():
            error.show()
            return error.exit_code
        case _ if any(isinstance(one, click.Abort | KeyboardInterrupt) for one in _chain(error)):
            # An import turns an interrupt into an error of its own, which has it as its cause.
            click.echo("Interrupted.", err=True)
            return INTERRUPTED
        case OSError(errno=errno.EPIPE):
            # The reader of the pipe is gone; what is still buffered must not fail at exit.
            if sys.stdout is not None:
                os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            return FAILED
        case EvenbreakError() | OSError() | MemoryError() | OverflowError():
            pass
        case UnicodeDecodeError() if _in_matplotlib(error):
            error = InputError(
                f"matplotlib can't read its settings ({error}). Fix or remove the file "
                "matplotlibrc in this folder."
            )
        case _:
            raise error
    for line in _lines(error):
        click.echo(f"Error: {line}", err=True)
    match error:
        case DataError():
            return BAD_DATA
        case InputError():
            return USAGE
    return FAILED


def _in_matplotlib(error: BaseException) -> bool:
    """Return whether an error comes from matplotlib as it loads, where it reads its settings."""
    place = error.__traceback__
    names = set()
    while place is not None:
        names.add(place.tb_frame.f_globals.get("__name__"))
        place = place.tb_next
    return "matplotlib" in names


def _chain(error: BaseException | None) -> Iterator[BaseException]:
    """Yield an error, its cause, the cause of that, and so on."""
    seen: set[int] = set()
    while error is not None and id(error) not in seen:
        seen.add(id(error))
        yield error
        error = error.__cause__ or error.__context__


def _lines(error: BaseException) -> Iterator[str]:
    match error:
        case DataError():
            yield from map(said, error.problems[:PROBLEMS_SHOWN])
            hidden = len(error.problems) - PROBLEMS_SHOWN
            if hidden > 0:
                yield f"and {hidden:,} more problem{'s' if hidden > 1 else ''}"
        case OSError(filename=None, errno=code) if code in NO_ROOM:
            # An error about a file names it; this one is about stdout.
            yield f"standard output: {error.strerror}"
        case OSError(filename=None):
            yield str(error.strerror or error)
        case OSError():
            yield f"{error.filename}: {error.strerror}"
        case MemoryError():
            yield "there isn't enough memory to answer this. Ask for less."
        case OverflowError():
            yield "the answer is larger than the largest number a computer can hold"
        case EvenbreakError():
            yield " ".join(said(error.sentence).split())
        case _:
            yield " ".join(str(error).split())
