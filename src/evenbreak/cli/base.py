"""The program `evenbreak`: its list of commands, and what an error looks like from outside.

Exit codes: 0 done, 1 failed, 2 usage, 3 bad data, 130 interrupted.
"""

from __future__ import annotations

import errno
import gc
import importlib
import os
import sys
from collections.abc import Iterator, Sequence
from typing import Any

import click

from evenbreak import __version__
from evenbreak.errors import DataError, EvenbreakError, InputError

__all__ = ["COMMANDS", "Program", "main", "report_error"]

COMMANDS = {
    "report": "Make the fair-race sheet of a league from its results file.",
    "odds": "Answer what the chances of a match are, and how long it lasts.",
    "fair": "Find the race that is nearest to an even chance.",
    "chain": "Find the stochastic limit of any chain, from a file of arcs.",
}
"""Each command with its line of help; module and function bear the command's name."""

PROBLEMS_SHOWN = 20
FAILED, USAGE, BAD_DATA, INTERRUPTED = 1, 2, 3, 130

TOLD = (
    click.ClickException,
    click.Abort,
    KeyboardInterrupt,
    EvenbreakError,
    OSError,
    MemoryError,
    OverflowError,
)
"""What ends a command without a traceback; anything else is a fault of this program."""


class Program(click.Group):
    """A click group that imports a command only to run it, and ends with the exit codes above."""

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        """Run as a program, which ends when this returns."""
        try:
            return super().__call__(*args, **kwargs)
        finally:
            # A person waits until the process has gone: at its end the collector would
            # walk once more through all that was imported, a tenth of the whole time.
            gc.freeze()

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002
        """Return the names of the commands, in the order of the help text."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002
        """Import and return a command, or None if there is none of that name."""
        if cmd_name not in COMMANDS:
            return None
        module = importlib.import_module(f"evenbreak.cli.{cmd_name}")
        command: click.Command = getattr(module, cmd_name)
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002
        """Write the list of commands from the table, without importing any."""
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))

    def main(
        self,
        args: Sequence[str] | None = None,
        prog_name: str | None = None,
        complete_var: str | None = None,
        standalone_mode: bool = True,
        **extra: Any,
    ) -> Any:
        """Run a command and exit; with `standalone_mode=False` return, and let errors pass."""
        if not standalone_mode:
            return super().main(args, prog_name, complete_var, standalone_mode=False, **extra)
        try:
            code = super().main(args, prog_name, complete_var, standalone_mode=False, **extra)
            if sys.stdout is not None:
                sys.stdout.flush()
        except TOLD as error:
            code = report_error(error)
        sys.exit(code or 0)


def report_error(error: BaseException) -> int:
    """Say on stderr what went wrong, a line for each problem, and return the exit code."""
    match error:
        case click.ClickException():
            error.show()
            return error.exit_code
        case click.Abort() | KeyboardInterrupt():
            click.echo("Interrupted.", err=True)
            return INTERRUPTED
        case OSError(errno=errno.EPIPE):
            # The reader has gone. What is still buffered must not fail again at exit.
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            return FAILED
    for line in _lines(error):
        click.echo(f"Error: {line}", err=True)
    match error:
        case DataError():
            return BAD_DATA
        case InputError():
            return USAGE
    return FAILED


def _lines(error: BaseException) -> Iterator[str]:
    match error:
        case DataError():
            yield from error.problems[:PROBLEMS_SHOWN]
            hidden = len(error.problems) - PROBLEMS_SHOWN
            if hidden > 0:
                yield f"and {hidden:,} more problem{'s' if hidden > 1 else ''}"
        case OSError(filename=None):
            yield str(error.strerror or error)
        case OSError():
            yield f"{error.filename}: {error.strerror}"
        case MemoryError():
            yield "not enough memory for this question; ask a smaller one"
        case OverflowError():
            yield "the answer is beyond the largest number that a computer holds"
        case _:
            yield " ".join(str(error).split())


@click.command("evenbreak", cls=Program, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="evenbreak", message="%(prog)s %(version)s")
def main() -> None:
    """Fair races, odds and ratings for pool, from Markov chains."""
