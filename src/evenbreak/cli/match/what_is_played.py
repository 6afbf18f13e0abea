"""The match: a race or n-ahead, perhaps in sets, perhaps from a score on."""

from typing import Any

import click

from evenbreak.answers.match.two_players import TwoPlayers
from evenbreak.cli.kit.options import Command, with_options
from evenbreak.cli.kit.players import players_of
from evenbreak.cli.kit.values import PAIR, SCORE, Whole, refuse
from evenbreak.games.match import Match
from evenbreak.games.race import Race
from evenbreak.matches.formats import LONGEST

MOST_SCORES = 10_000
"""The most scores that a match may still come to, so that every answer takes seconds."""
MOST_BY_WAY = 25_000
"""The most scores of a race of games, if its graph is solved in floats: a race 158:158."""


def match_options(command: Command) -> Command:
    """Add the options that describe the match."""
    return with_options(
        command,
        click.option(
            "--win-by",
            type=Whole(1, LONGEST),
            metavar="K",
            help="The race goes on until one player leads by K, counted from what each needs.",
        ),
        click.option(
            "--score", metavar="I:J", type=SCORE, help="The score so far: I for A, J for B."
        ),
        click.option(
            "--set",
            "set_",
            metavar="N|M:N",
            type=PAIR,
            help="Play sets, each of them a race M:N; --race then counts sets.",
        ),
        click.option(
            "--ahead",
            metavar="N|M:N",
            type=PAIR,
            help="A wins by leading by M games, B by leading by N.",
        ),
        click.option(
            "--race",
            metavar="N|M:N",
            type=PAIR,
            help="A needs M games, B needs N; 7 means 7:7.",
        ),
    )


def match_of(
    *,
    race: tuple[int, int] | None,
    ahead: tuple[int, int] | None,
    set_: tuple[int, int] | None,
    score: tuple[int, int] | None,
    win_by: int | None,
    **who: Any,
) -> tuple[TwoPlayers, Match]:
    """Return the players and the match of the options, or refuse what contradicts itself."""
    players = players_of(**who)
    if race is not None and ahead is not None:
        refuse("--race and --ahead cannot be combined; leave one out")
    if win_by is not None and (ahead or set_):
        refuse(f"--win-by cannot be combined with {'--ahead' if ahead else '--set'}; leave it out")
    rack: Any = players.rack
    breaks, first = players.break_format, players.first_breaker
    start = score or (0, 0)
    if set_ is not None:  # the break format carries on across sets, so only the set needs it
        rack = Race(set_[0], set_[1], rack, breaks=breaks, first_breaker=first)
        breaks = None
    if ahead is not None:
        from evenbreak.games.ahead import Ahead

        return players, Ahead(*ahead, rack, breaks=breaks, first_breaker=first, score=start)
    if race is None:
        refuse("the match is missing; give --race M:N or --ahead M:N")
    return players, Race(
        *race, rack, breaks=breaks, first_breaker=first, score=start, win_by=win_by or 1
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
