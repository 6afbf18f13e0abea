"""The program `evenbreak`: its list of commands, and how one of them is run."""

import sys
from collections.abc import Sequence
from typing import Any

import click

from evenbreak import __version__
from evenbreak.cli.interrupts import raise_if_interrupted, stop_listening
from evenbreak.cli.kit.groups import Entry, LazyGroup

SECTIONS = {
    "Start here": {
        "demo": Entry("Made-up files, and three commands to try on them.", "start:demo")
    },
    "Run a match": {
        "odds": Entry("The odds and the length of one match."),
        "live": Entry("The odds of a match under way, game by game."),
        "fair": Entry("The fairest race for two players."),
        "compare": Entry("Match formats side by side: who each one favors."),
        "breaks": Entry("What each break format is worth, and fair stakes."),
        "straight": Entry("Straight pool: who wins, and which spot is fair."),
    },
    "Run a tournament": {
        "tournament": Entry("Tonight's tournament: title odds and finish time.", "tournament"),
        "chips": Entry("Chip tournaments: odds, and fair chip charts.", "groups:chips"),
        "serve": Entry("Tonight's tournament on a page for phones and a screen.", "start:serve"),
    },
    "Run teams": {
        "lineup": Entry("Who to put up now, and what each choice is worth.", "team.lineup"),
        "round": Entry(
            "A round of two teams: who wins, and the fair head start.", "team.league:round_"
        ),
        "caps": Entry("How a cap and the put-up order affect a league.", "team.league:caps"),
        "season": Entry("A team season: title, promotion, relegation.", "team.league:season"),
    },
    "Run a league": {
        "report": Entry("A league's fair-race sheet, from its results.", "league.report"),
        "publish": Entry("The league as a website: a folder of plain files.", "league.publish"),
        "rate": Entry("Ratings from results, and how certain each one is.", "league.ratings:rate"),
        "why": Entry("Why two players have the ratings and race they do.", "league.ratings:why"),
        "matchups": Entry("Tonight's races for a list of rated players.", "league.matchups"),
        "validate": Entry(
            "How well the ratings predict your own results.", "league.ratings:validate"
        ),
        "simulate": Entry("A season played out many times: who benefits?", "league.simulate"),
        "league": Entry("A league's standings and fixtures, from its folder.", "groups:league"),
    },
    "Handicap systems": {
        "systems": Entry("The handicap systems and their charts."),
        "chart": Entry("Handicap charts: list, show, audit or design one.", "groups:chart"),
        "ladder": Entry("How far off ratings get under a handicap system."),
        "sandbag": Entry("How much losing on purpose pays, and how to spot it.", "groups:sandbag"),
    },
    "Practice": {
        "practice": Entry("Practice scores: are you getting better?"),
        "drill": Entry("A progressive drill: your level, and what to work on."),
        "runs": Entry("How long runs get, and the total of several innings."),
        "oneball": Entry("The one-ball game: who wins, and which shot to play."),
    },
    "The physics of the table": {
        "physics": Entry("Ball, cloth and cue: throw, aim, spin, speed.", "groups:physics")
    },
    "The engine": {
        "graph": Entry("A game's graph, matrix, eigenvalues and limit, as files.", "match.graph"),
        "chain": Entry("Any Markov chain in a file: where it ends.", "match.graph:chain"),
        "reproduce": Entry("Every table, figure and number in the source text.", "start:reproduce"),
    },
}
"""The commands by who needs them, each with its module and its line of help."""

COMMANDS = {
    name: entry._replace(section=section)
    for section, entries in SECTIONS.items()
    for name, entry in entries.items()
}
"""Each command by name."""


class Program(LazyGroup):
    """The group of all commands; it exits with the code of the command that ran."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Read the words; `help` and `version` may come without dashes, as elsewhere."""
        if args[:1] == ["help"]:
            args = [*args[1:], "--help"]
        elif args == ["version"]:
            args = ["--version"]
        return super().parse_args(ctx, args)

    def main(
        self,
        args: Sequence[str] | None = None,
        prog_name: str | None = None,
        complete_var: str | None = None,
        standalone_mode: bool = True,
        **extra: Any,
    ) -> Any:
        """Run a command and exit; with `standalone_mode=False`, return and let errors through."""
        if not standalone_mode:
            return super().main(args, prog_name, complete_var, standalone_mode=False, **extra)
        try:
            code = super().main(args, prog_name, complete_var, standalone_mode=False, **extra)
            raise_if_interrupted()
            if sys.stdout is not None:
                sys.stdout.flush()
        except (Exception, KeyboardInterrupt) as error:
            stop_listening()
            from evenbreak.cli.kit.said import report_error

            code = report_error(error)
        sys.exit(code or 0)


@click.command(
    "evenbreak",
    cls=Program,
    table=COMMANDS,
    context_settings={"help_option_names": ["-h", "--help"], "show_default": True},
    epilog="evenbreak COMMAND --help shows a command's options, with examples.",
)
@click.version_option(__version__, prog_name="evenbreak", message="%(prog)s %(version)s")
def program() -> None:
    """Fair races, odds and ratings for pool."""
