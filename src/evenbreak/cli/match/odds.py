"""`evenbreak odds`: the odds of a match, and how long it lasts."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import PlainCommand
from evenbreak.cli.kit.players import player_options, players_of
from evenbreak.cli.match.what_is_played import match_of, match_options, refuse_giants

if TYPE_CHECKING:
    from evenbreak.answers.answer import Answer

EXAMPLES = """\b
Examples:
  evenbreak odds 612 521 --scale fargo --race 7:5
  evenbreak odds --p 0.6 --ahead 5:3
  evenbreak odds --p1 0.6 --p2 0.5 --breaks winner --race 9:9 --score 4:6
  evenbreak odds --p 0.66 --race 3:1 --set 3:3
"""


@click.command("odds", cls=PlainCommand, epilog=EXAMPLES)
@player_options
@match_options
@faces()
def command(
    race: tuple[int, int] | None,
    ahead: tuple[int, int] | None,
    set_: tuple[int, int] | None,
    score: tuple[int, int] | None,
    win_by: int | None,
    **who: Any,
) -> Answer:
    """Give the odds of a match, and how long it lasts.

    The players: two ratings A B; or --p; or --p1, --p2 and --breaks. The match: --race or
    --ahead, perhaps in sets.
    """
    from evenbreak.answers.odds import odds_answer

    players = players_of(**who)
    match = match_of(players, race=race, ahead=ahead, set_=set_, score=score, win_by=win_by)
    if getattr(match, "win_by", 0) != 1 or match.rack is not players.rack:  # no plain race
        refuse_giants(match)
    return odds_answer(players, match)
