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
    "odds": Entry("match.odds", "Answer what the chances of a match are, and how long it lasts."),
    "live": Entry("match.live", "Tell the odds of a match under way, rack by rack."),
    "compare": Entry(
        "match.compare", "Compare match formats: who gains by which, and where they cross."
    ),
    "fair": Entry("match.fair", "Find the race that is nearest to an even chance."),
    "matchups": Entry("league.matchups", "Tell tonight's races for a list of rated players."),
    "chart": Entry("chart", "List and show handicap charts, audit one, or design one."),
    "ladder": Entry(
        "ladder.ladder", "Show how far off ratings are in the long run, and what helps."
    ),
    "sandbag": Entry("sandbag", "Show what losing on purpose pays, and watch for it."),
    "simulate": Entry(
        "league.simulate", "Simulate a league's season: ratings, fairness, who gains."
    ),
    "validate": Entry("league.validate", "Tell how far the ratings of a league can be trusted."),
    "oneball": Entry("match.oneball", "Answer who wins the one-ball game, and which shot is best."),
    "breaks": Entry(
        "match.breaks", "Weigh break formats and stakes for two players, in the long run."
    ),
    "runs": Entry("practice.runs", "Answer how long runs are, and what several innings bring."),
    "straight": Entry(
        "match.straight", "Answer who wins at straight pool, and what handicap is even."
    ),
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
    "chain": Entry("match.chain", "Find the stochastic limit of any chain, from a file of arcs."),
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
