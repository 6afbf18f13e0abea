"""`evenbreak live`: a match under way, game by game."""

from dataclasses import replace
from typing import Any

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import PlainCommand, form_option
from evenbreak.cli.kit.players import player_options
from evenbreak.cli.kit.plot import plot_option, write_plot
from evenbreak.cli.kit.values import SCORE, refuse
from evenbreak.cli.match.what_is_played import match_of, match_options, refuse_giants

EXAMPLES = """\b
Examples:
  evenbreak live 612 521 --scale fargo --race 7:5 --racks abbab
  evenbreak live "Ann Lee" "Bo Diaz" --from ratings.csv --race 7:5 --racks abb
  evenbreak live --p 0.6 --race 9:7 --score 4:6
  evenbreak live --p 0.6 --race 7:5 --table
  evenbreak live --p 0.6 --race 3:3 --set 4:3 --score 1:0 --set-score 2:2
"""


def _racks(ctx: click.Context, param: click.Parameter, value: str | None) -> list[int]:
    """Return the winner of each rack, 1 or 2."""
    letters = "".join((value or "").lower().replace(",", " ").split())
    for letter in letters:
        if letter not in "ab":
            message = (
                f"{letter!r} is neither a nor b; write one of them for each rack, such as abbab"
            )
            raise click.BadParameter(message, ctx=ctx, param=param)
    return ["ab".index(letter) + 1 for letter in letters]


@click.command("live", cls=PlainCommand, epilog=EXAMPLES)
@player_options
@match_options
@click.option(
    "--set-score",
    metavar="I:J",
    type=SCORE,
    help="The score of the set under way, before the games of --racks.",
)
@click.option(
    "--racks", metavar="abbab...", callback=_racks, help="Who won each game since --score."
)
@click.option(
    "--table", is_flag=True, help="Add the comeback table: the odds at each score to come."
)
@form_option
@plot_option
@faces()
def command(
    set_score: tuple[int, int] | None,
    racks: list[int],
    table: bool,
    plot: str | None,
    **asked: Any,
) -> Answer:
    """Follow a match under way: the odds now, the worth of the next game, the turning point.

    Describe the players and the match as for `odds`, and the score by --racks, by --score,
    or by both: the racks are then those played since that score.
    """
    from evenbreak.answers.match.live import live_answer
    from evenbreak.matches.live import live_odds, order_is_free

    players, match = match_of(**asked)
    if set_score is not None and asked["set_"] is None:
        refuse("--set-score is the score of a set, but there is no --set; leave it out")
    if plot is not None and not racks:
        refuse("--plot draws the match as it went; give --racks, such as abbab")
    refuse_giants(match)
    if players.form and not order_is_free(match):
        if asked["form"] is not None:
            refuse(
                "--form is for races of games in which the break does not matter; leave it out here"
            )
        players = replace(players, form=0.0)
    odds = live_odds(match, racks, set_score=set_score, form=players.form)
    answer = live_answer(players, match, odds, comebacks=table)
    if plot is not None:
        from evenbreak.plots.live_match import plot_course

        write_plot(plot_course(odds, title=answer.heading, names=players.names), plot)
    return answer
