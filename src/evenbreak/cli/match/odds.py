"""`evenbreak odds`: the odds of a match, and how long it lasts."""

from typing import Any

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.chains.ways import Way
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import PlainCommand, form_option, via_option
from evenbreak.cli.kit.players import player_options, refuse_uncertain
from evenbreak.cli.kit.values import refuse
from evenbreak.cli.match.what_is_played import MOST_BY_WAY, match_of, match_options, refuse_giants

EXAMPLES = """\b
Examples:
  evenbreak odds 612 521 --scale fargo --race 7:5
  evenbreak odds "Ann Lee" "Bo Diaz" --from ratings.csv --race 7:5
  evenbreak odds --p 0.6 --ahead 5:3
  evenbreak odds --p1 0.6 --p2 0.5 --breaks winner --race 9:9 --score 4:6
  evenbreak odds --p 0.66 --race 3:1 --set 3:3
  evenbreak odds --p 0.6 --race 9:9 --form 0.35
  evenbreak odds --p 0.6 --race 5:4 --exact
  evenbreak odds --p 0.6 --race 5:4 --via eigen
"""


@click.command("odds", cls=PlainCommand, epilog=EXAMPLES)
@player_options
@match_options
@form_option
@click.option(
    "--exact",
    is_flag=True,
    help="Also give the chances of winning as fractions; needs --p, or --p1 and --p2.",
)
@via_option
@faces()
def command(*, exact: bool, via: Way | None, **asked: Any) -> Answer:
    """Give the odds of a match, and how long it lasts.

    Describe the players by two ratings A B, by two names with --from, by --p, or by --p1, --p2 and
    --breaks; the match by --race or --ahead, perhaps in sets.
    """
    from evenbreak.answers.match.odds import odds_answer

    players, match = match_of(**asked)
    if exact and players.ratings is not None:
        refuse("--exact needs the chances themselves: give --p, or --p1 and --p2, not ratings")
    if exact and via is not None:
        refuse("--exact has a way of its own; leave --via out")
    if exact and players.form:
        refuse("--exact has no fractions with --form; leave one out")
    if players.form and players.breaks is not None and any(match.score):
        refuse(
            "the games played show the form of the day, but not without who broke them; leave "
            "--score out, or --form"
        )
    if via is not None:
        refuse_uncertain(players)
    is_plain = getattr(match, "win_by", 0) == 1 and match.rack is players.rack
    if exact or not is_plain:
        refuse_giants(match)
    elif via is not None:
        refuse_giants(match, MOST_BY_WAY)
    return odds_answer(players, match, exact=exact, via=via)
