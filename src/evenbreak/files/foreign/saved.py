"""A tournament saved by another program: the same object, whatever the program.

Results and an evening's events are both read from it. A problem with a single match is kept with
the match, and a problem that prevents rebuilding the bracket is kept with the tournament: results
need no bracket.
"""

from __future__ import annotations

import re
import reprlib
import unicodedata
from collections.abc import Callable, Mapping
from enum import Enum
from typing import Any, NamedTuple, TypeAlias

from evenbreak.errors import EvenbreakError
from evenbreak.words import say


class Remark(Enum):
    """Something to count, in words: singular and plural."""

    BYE = "bye", "byes"
    UNFINISHED = "match that was not finished", "matches that were not finished"
    NO_SCORE = "match finished without a score", "matches finished without a score"
    FORFEIT = "forfeit", "forfeits"
    HEAD_START = (
        "match counted without the head start in its score",
        "matches counted without the head starts in their scores",
    )
    NO_RACE = (
        "match whose score doesn't complete its race (race ignored)",
        "matches whose scores don't complete their races (races ignored)",
    )
    FEWER_GAMES = (
        "match whose stated winner won fewer games (winner ignored)",
        "matches whose stated winners won fewer games (winners ignored)",
    )
    NO_DATE = (
        "match whose time can't be read as a date",
        "matches whose times can't be read as dates",
    )
    SETS = "set of a longer match counted as a match", "sets of longer matches counted as matches"

    def counted(self, n: int) -> str:
        """Return a count in words."""
        one, several = self.value
        return say("{n:,} {matches}", n=n, matches=one if n == 1 else several)


TITLES = (
    *("date", "event", "player_a", "player_b", "score_a", "score_b"),
    *("race_a", "race_b", "winner", "forfeit"),
)
"""The columns of `Played.row`."""

MISSHAPEN = (LookupError, TypeError, ValueError, AttributeError, ArithmeticError, StopIteration)
"""The exceptions that a file raises if it isn't built the way its program builds files."""

_MOST = 9_999_999
_DAY = re.compile(r"\d{4}-\d{2}-\d{2}(?!\d)", re.ASCII)
_NOBODY = re.compile(r"(walk ?over|w/?o|bye|tbd|-+|\?+)?", re.IGNORECASE)


class ExportError(EvenbreakError):
    """What is wrong with one match, or with all matches."""


class Played(NamedTuple):
    """A match, or one of its sets, that counts as a result.

    Scores leave out games given as a head start. Races not stated are 0, and other fields not
    stated are ''; the winner is 'a', 'b' or ''.
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
        """Return the cells for the columns in `TITLES`."""
        scored = not self.forfeit
        return [
            *(self.date, self.event, self.player_a, self.player_b),
            *((str(self.score_a), str(self.score_b)) if scored else ("", "")),
            *((str(self.race_a), str(self.race_b)) if self.race_a and scored else ("", "")),
            *(self.winner, "yes" if self.forfeit else ""),
        ]

    def fitting_race(self) -> Played:
        """Return the match, without its race if the score doesn't finish that race."""
        reached = self.score_a >= self.race_a, self.score_b >= self.race_b
        over = self.score_a > self.race_a or self.score_b > self.race_b
        if not (self.race_a and self.race_b) or (reached[0] != reached[1] and not over):
            return self
        return self._replace(race_a=0, race_b=0, remarks=(*self.remarks, Remark.NO_RACE))

    def won_by(self, winner: str) -> Played:
        """Return the match with its winner, or without if the other player won more games."""
        if winner and winner != ("a" if self.score_a > self.score_b else "b"):
            return self._replace(remarks=(*self.remarks, Remark.FEWER_GAMES))
        return self._replace(winner=winner)


From: TypeAlias = tuple[Any, str]
"""Another match's key, and an outcome: winner or loser."""

Slots: TypeAlias = tuple[str | From | None, ...]
"""Who is in a match: names, outcomes of other matches, or byes (None)."""


class SavedMatch(NamedTuple):
    """A match in a saved tournament.

    `key` is its number in the file, or None for a second final that the file leaves out. `played`
    has its result, or several sets; if it's empty, `left_out` has the reason. The side is winners,
    losers, final, second final or third place; the winner is 1, 2 or 0. `pair` and `score` are for
    a match in progress.
    """

    key: Any
    played: tuple[Played, ...] = ()
    left_out: Remark | None = None
    problem: str = ""
    side: str = ""
    round: int = 0
    slots: Slots = ()
    winner: int = 0
    race: int = 0
    table: str = ""
    started: str = ""
    ended: str = ""
    pair: tuple[str, str] = ("", "")
    score: tuple[int, int] | None = None


class SavedTournament(NamedTuple):
    """A saved tournament, with its matches in file order.

    `refusal` is the reason the bracket can't be rebuilt; the matches then have no place in a
    bracket.
    """

    matches: tuple[SavedMatch, ...]
    name: str = ""
    players: tuple[str, ...] = ()
    everybody: bool = False
    discipline: str = ""
    refusal: str = ""

    def placed(self, place: Callable[[SavedTournament], SavedTournament]) -> SavedTournament:
        """Return the tournament with its bracket, or with the reason it has none."""
        try:
            return place(self)
        except ExportError as error:
            return self._replace(refusal=error.sentence)
        except MISSHAPEN:
            return self._replace(refusal=misshapen())


def misshapen() -> str:
    """Return the error for a file that isn't built the way its program builds files."""
    return say("doesn't have the expected structure. Save it again in the other program.")


def match_of(key: Any, read: Callable[[], tuple[Played, ...] | Remark], *times: Any) -> SavedMatch:
    """Return a match with its results, dated by its first time, or with its problem.

    `read` returns the results or the reason there are none; times look like
    2024-09-03T19:30:00+02:00.
    """
    try:
        played = read()
    except ExportError as error:
        return SavedMatch(key, problem=error.sentence)
    if isinstance(played, Remark):
        return SavedMatch(key, left_out=played)
    stated = [str(time) for time in times if time]
    days = [day[0] for time in stated if (day := _DAY.match(time))]
    remarks = (Remark.NO_DATE,) if stated and not days else ()
    date = days[0] if days else ""
    return SavedMatch(
        key, tuple(part._replace(date=date, remarks=(*part.remarks, *remarks)) for part in played)
    )


def text_of(value: Any) -> str:
    """Return a file's value as a string, '' for nothing."""
    return str(value or "")


def name_of(player: Any, what: str) -> str:
    """Return a player's name, '' for no one (a bye, or not known yet)."""
    if player is None:
        return ""
    name = player.get("name") if isinstance(player, Mapping) else player
    if name is not None and not isinstance(name, str):
        raise ExportError("has no name for {player}", player=what)
    text = " ".join((name or "").split())
    if any(unicodedata.category(letter) in ("Cc", "Cs") for letter in text):
        raise ExportError("has a name for {player} that can't be printed", player=what)
    return "" if _NOBODY.fullmatch(text) else text


def player_of(names: Mapping[Any, str], number: Any) -> str:
    """Return the name of the participant with this number."""
    name = names.get(number)
    if not name:
        raise ExportError(
            "has player number {number!r}, but no named participant has that number", number=number
        )
    return name


def count_of(value: Any, what: str) -> int | None:
    """Return a whole number, at least 0; None if it isn't one."""
    if value is None or value == "":
        return None
    if isinstance(value, str) and re.fullmatch(r"\d{1,7}", value.strip(), re.ASCII):
        return int(value)
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if number and 0 <= value <= _MOST and value == int(value):
        return int(value)
    raise ExportError(
        "has {what} {value}, which isn't a whole number from 0 to {most:,}",
        what=what,
        value=reprlib.repr(value),
        most=_MOST,
    )
