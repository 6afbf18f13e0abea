"""`evenbreak odds`: the odds of a match, and how long it lasts."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import PlainCommand
from evenbreak.cli.kit.players import player_options, players_of
from evenbreak.cli.kit.values import refuse
from evenbreak.cli.match.what_is_played import MOST_SCORES, match_of, match_options
from evenbreak.games.rack import Rack

if TYPE_CHECKING:
    from evenbreak.answers.answer import Answer
    from evenbreak.games.match import Match

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
    _refuse_giants(match)
    return odds_answer(players, match)


def _refuse_giants(match: Match) -> None:
    """Refuse a match that would take minutes."""
    from evenbreak.answers.odds import match_words

    win_by, inner = getattr(match, "win_by", None), match.rack
    if win_by == 1 and isinstance(inner, Rack):
        return
    scores = match.m + match.n if win_by is None else max(match.m, win_by) * max(match.n, win_by)
    if not isinstance(inner, Rack):
        scores *= inner.m * inner.n
    if scores > MOST_SCORES:
        refuse(
            f"{match_words(match)} is too long to work out here, with about {scores:,} scores; "
            f"ask for a match with at most {MOST_SCORES:,}"
        )
