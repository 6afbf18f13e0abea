"""A match as another program's file holds it, and the reading of its parts."""

from __future__ import annotations

import re
import reprlib
import unicodedata
from collections.abc import Callable, Iterator, Mapping
from typing import Any, NamedTuple

Remark = tuple[str, str]
"""Something to count, in words: one, and several."""

BYE = "bye", "byes"
UNFINISHED = "match that was not finished", "matches that were not finished"
NO_SCORE = "match finished without a score", "matches finished without a score"
FORFEIT = "forfeit", "forfeits"
HEAD_START = (
    "match counted without the head start in its score",
    "matches counted without the head starts in their scores",
)
NO_RACE = (
    "match read without its race, which the score does not end",
    "matches read without their races, which the scores do not end",
)
FEWER_GAMES = (
    "match read without its winner, who won fewer games",
    "matches read without their winners, who won fewer games",
)
NO_DATE = "match whose time cannot be read as a date", "matches whose times cannot be read as dates"
SETS = "set of a longer match counted as a match", "sets of longer matches counted as matches"

_DAY = re.compile(r"\d{4}-\d{2}-\d{2}(?!\d)", re.ASCII)

TITLES = (
    *("date", "event", "player_a", "player_b", "score_a", "score_b"),
    *("race_a", "race_b", "winner", "forfeit"),
)
"""The columns of `Match.row`."""

_NOBODY = re.compile(r"(walk ?over|w/?o|bye|tbd|-+|\?+)?", re.IGNORECASE)


class Match(NamedTuple):
    """A match as read from an export.

    Parameters
    ----------
    player_a, player_b
        the names.
    score_a, score_b
        games won, without those given as a head start.
    race_a, race_b
        the games that each had to win; 0 where not stated.
    date, event
        as text; '' where not stated.
    winner
        a, b or ''.
    forfeit
        whether it was one.
    remarks
        what is counted, such as `HEAD_START`.
    """

    player_a: str
    player_b: str
    score_a: int = 0
    score_b: int = 0
    race_a: int = 0
    race_b: int = 0
    date: str = ""
    event: str = ""
    winner: str = ""
    forfeit: bool = False
    remarks: tuple[Remark, ...] = ()

    def row(self) -> list[str]:
        """Return the cells below `TITLES`."""
        known = not self.forfeit
        return [
            *(self.date, self.event, self.player_a, self.player_b),
            *((str(self.score_a), str(self.score_b)) if known else ("", "")),
            *((str(self.race_a), str(self.race_b)) if self.race_a and known else ("", "")),
            *(self.winner, "yes" if self.forfeit else ""),
        ]


Found = Match | Remark
"""A match, or why there is none: `BYE`, `UNFINISHED` or `NO_SCORE`."""

Matches = Iterator[Callable[[], list[Found]]]
"""The matches of a tournament, each read when it is called."""


class ExportError(Exception):
    """What is wrong with one match, or with all of them."""


def name_of(player: Any, what: str) -> str:
    """Return the name of a player, '' for nobody (a bye, or not known yet)."""
    if player is None:
        return ""
    name = player.get("name") if isinstance(player, Mapping) else player
    if name is not None and not isinstance(name, str):
        raise ExportError(f"has no name for {what}")
    text = " ".join((name or "").split())
    if any(unicodedata.category(letter) in ("Cc", "Cs") for letter in text):
        raise ExportError(f"has a name for {what} that cannot be printed")
    return "" if _NOBODY.fullmatch(text) else text


def player_of(names: Mapping[Any, str], number: Any) -> str:
    """Return the name of the participant with this number."""
    name = names.get(number)
    if not name:
        raise ExportError(f"is played by number {number!r}, which no participant with a name has")
    return name


_MOST = 9_999_999


def count_of(value: Any, what: str) -> int | None:
    """Return a whole number from 0, None where there is none."""
    if value is None or value == "":
        return None
    if isinstance(value, str) and re.fullmatch(r"\d{1,7}", value.strip(), re.ASCII):
        return int(value)
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if number and 0 <= value <= _MOST and value == int(value):
        return int(value)
    shown = reprlib.repr(value)
    raise ExportError(f"has {what} {shown}, which is not a whole number from 0 to {_MOST:,}")


def dated(found: list[Found], *times: Any) -> list[Found]:
    """Return matches on the day of the first time such as 2024-09-03T19:30:00+02:00."""
    stated = [str(time) for time in times if time]
    days = [day[0] for time in stated if (day := _DAY.match(time))]
    remarks = (NO_DATE,) if stated and not days else ()
    return [
        one._replace(date=days[0] if days else "", remarks=(*one.remarks, *remarks))
        if isinstance(one, Match)
        else one
        for one in found
    ]


def fitting_race(match: Match) -> Match:
    """Return a match without its race if the score does not end that race."""
    reached = match.score_a >= match.race_a, match.score_b >= match.race_b
    over = match.score_a > match.race_a or match.score_b > match.race_b
    if not (match.race_a and match.race_b) or (reached[0] != reached[1] and not over):
        return match
    return match._replace(race_a=0, race_b=0, remarks=(*match.remarks, NO_RACE))


def with_winner(match: Match, winner: str) -> Match:
    """Return a match with its winner, or without if the other player won more games."""
    if winner and winner != ("a" if match.score_a > match.score_b else "b"):
        return match._replace(remarks=(*match.remarks, FEWER_GAMES))
    return match._replace(winner=winner)
