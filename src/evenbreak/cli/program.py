"""The program `evenbreak`: its list of commands, and how one is found and run."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import click

from evenbreak import __version__
from evenbreak.cli.kit.groups import Entry, LazyGroup

COMMANDS = {
    "report": Entry("league.report", "Make the fair-race sheet of a league from its results file."),
    "rate": Entry(
        "league.rate", "Rate players from their results, and say how sure each rating is."
    ),
    "odds": Entry("match.odds", "Give the odds of a match, and how long it lasts."),
    "live": Entry("match.live", "Follow a match under way: the odds after every game."),
    "compare": Entry("match.compare", "Compare match formats: which is better for whom."),
    "fair": Entry("match.fair", "Find the fairest races for two players."),
    "matchups": Entry("league.matchups", "Tell tonight's races for a list of rated players."),
    "chart": Entry("chart", "List and show handicap charts, audit one, or design one."),
    "ladder": Entry("ladder.ladder", "Tell how wrong a league's ratings are, how fair its nights."),
    "sandbag": Entry("sandbag", "Tell what losing on purpose pays, and watch for it."),
    "simulate": Entry(
        "league.simulate", "Simulate a league's season: ratings, nights, who profits."
    ),
    "validate": Entry("league.validate", "Tell how far the ratings of a league can be trusted."),
    "oneball": Entry("match.oneball", "Choose the best shot in the one-ball game."),
    "breaks": Entry("match.breaks", "Compare break formats and stakes over a long session."),
    "runs": Entry("practice.runs", "Answer how long runs are, and what several innings bring."),
    "straight": Entry("match.straight", "Give the odds of a straight pool match, and a fair spot."),
    "drill": Entry(
        "practice.drill", "Find where a progressive drill settles, and what to practise."
    ),
    "practice": Entry(
        "practice.practice", "Tell what practice scores say: was it luck, did it help?"
    ),
    "physics": Entry("physics", "Answer what ball, cloth and cue do: throw, aim, spin."),
    "reproduce": Entry(
        "reproduce", "Write all numbers and figures of the source text, computed anew."
    ),
    "chain": Entry("match.chain", "Find where any Markov chain ends, from a file of arcs."),
}
"""Each command, with its module and its line of help."""


class Program(LazyGroup):
    """The group of all commands, which ends with the exit code of what it ran."""

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
            from evenbreak.cli.kit.failures import report_error

            code = report_error(error)
        sys.exit(code or 0)


@click.command(
    "evenbreak",
    cls=Program,
    table=COMMANDS,
    context_settings={"help_option_names": ["-h", "--help"]},
)
@click.version_option(__version__, prog_name="evenbreak", message="%(prog)s %(version)s")
def program() -> None:
    """Fair races, odds and ratings for pool, from Markov chains."""
