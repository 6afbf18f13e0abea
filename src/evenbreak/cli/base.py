"""The program `evenbreak`: its list of commands, and how one is found and run."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Sequence
from typing import Any

import click

from evenbreak import __version__

__all__ = ["COMMANDS", "Program", "program"]

COMMANDS = {
    "report": "Make the fair-race sheet of a league from its results file.",
    "rate": "Rate players from their results, and say how sure each rating is.",
    "odds": "Answer what the chances of a match are, and how long it lasts.",
    "live": "Tell the odds of a match under way, rack by rack.",
    "compare": "Compare match formats: who gains by which, and where they cross.",
    "fair": "Find the race that is nearest to an even chance.",
    "matchups": "Tell tonight's races for a list of rated players.",
    "chart": "List and show handicap charts, audit one, or design one.",
    "ladder": "Tell how wrong a league's ratings are, how fair its nights.",
    "sandbag": "Tell what losing on purpose pays, and watch for it.",
    "simulate": "Simulate a league's season: ratings, nights, who profits.",
    "validate": "Tell how far the ratings of a league can be trusted.",
    "oneball": "Answer who wins the one-ball game, and which shot is best.",
    "breaks": "Weigh break formats and stakes for two players, in the long run.",
    "runs": "Answer how long runs are, and what several innings bring.",
    "straight": "Answer who wins at straight pool, and what handicap is even.",
    "drill": "Find where a progressive drill settles, and what to practise.",
    "practice": "Tell what practice scores say: was it luck, did it help?",
    "reproduce": "Write section 5 of the source text, computed anew.",
    "chain": "Find the stochastic limit of any chain, from a file of arcs.",
}
"""Each command with its line of help; module and function bear the command's name."""


class Program(click.Group):
    """A click group that imports a command only to run it, and ends with its exit code."""

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

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Return the command that the first word names, or say which it is nearest to."""
        name = args[0]
        if name not in COMMANDS and not name.startswith("-"):
            from difflib import get_close_matches

            near = get_close_matches(name, COMMANDS, n=1)
            ctx.fail(f"No such command {name!r}." + (f" Did you mean {near[0]!r}?" if near else ""))
        return super().resolve_command(ctx, args)

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
        except (Exception, KeyboardInterrupt) as error:
            from evenbreak.cli.failures import report_error

            code = report_error(error)
        sys.exit(code or 0)


@click.command("evenbreak", cls=Program, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="evenbreak", message="%(prog)s %(version)s")
def program() -> None:
    """Fair races, odds and ratings for pool, from Markov chains."""
