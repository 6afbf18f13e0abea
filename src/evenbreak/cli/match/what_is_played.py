"""The match: a race or n-ahead, perhaps in sets, perhaps from a score on."""

from typing import Any

from evenbreak.answers.match.odds import TwoPlayers
from evenbreak.cli.kit.players import players_of
from evenbreak.cli.kit.values import refuse
from evenbreak.games.match import Match
from evenbreak.games.race import Race
from evenbreak.questions.match import Live, Odds

MOST_SCORES = 10_000
"""The most scores that a match may still come to, so that every answer takes seconds."""
MOST_BY_WAY = 25_000
"""The most scores of a race of games, if its graph is solved in floats: a race 158:158."""


def match_of(asked: Odds | Live) -> tuple[TwoPlayers, Match]:
    """Return the players and the match that a question describes."""
    players = players_of(asked, asked.form)
    rack: Any = players.rack
    breaks, first = players.break_format, players.first_breaker
    start = asked.score or (0, 0)
    if asked.set_ is not None:  # the break format carries on across sets: only the set needs it
        rack = Race(*asked.set_, rack, breaks=breaks, first_breaker=first)
        breaks = None
    if asked.ahead is not None:
        from evenbreak.games.ahead import Ahead

        return players, Ahead(*asked.ahead, rack, breaks=breaks, first_breaker=first, score=start)
    m, n = asked.race or (1, 1)
    return players, Race(
        m, n, rack, breaks=breaks, first_breaker=first, score=start, win_by=asked.win_by or 1
    )


def refuse_giants(match: Match, most: int = MOST_SCORES) -> None:
    """Refuse a match that can still come to so many scores that it would take minutes."""
    from evenbreak.answers.match.odds import match_words

    win_by = getattr(match, "win_by", 0)
    left = [
        max(need - has, win_by, 1)
        for need, has in zip((match.m, match.n), match.score, strict=True)
    ]
    scores = left[0] * left[1] if win_by else match.m + match.n
    scores *= getattr(match.rack, "m", 1) * getattr(match.rack, "n", 1)
    if scores > most:
        refuse(
            f"{match_words(match)} can still come to about {scores:,} scores; ask for a match "
            f"with at most {most:,}"
        )
