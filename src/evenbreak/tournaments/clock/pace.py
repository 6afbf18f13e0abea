"""How long a match takes: an overhead and so much a game, times the luck of the match and evening.

    minutes = level (overhead + per_game games) exp(match_sd Z) exp(evening_sd Y),

Z new in each match, Y shared by all matches of an evening, both standard normal. What the
matches played so far say of Y is a normal posterior.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from evenbreak.checks import number, positive
from evenbreak.errors import InputError

_SOURCE = (
    "fitted to timed matches of one city before 2023; the level and the spread of evenings "
    "calibrated so that 10-90 % bands hold 80 % of real evenings whose rounds wait for each other"
)


@dataclass(frozen=True)
class Pace:
    """How long matches take.

    Parameters
    ----------
    overhead
        minutes of a match beside its games: racking for the first time, lagging, warming up.
    per_game
        minutes of a game.
    match_sd
        the standard deviation of the logarithm of a match's minutes around that.
    evening_sd
        that of the pace of an evening.
    level
        all times are multiplied by it.
    source
        where the numbers are from.

    >>> PACES["9-ball"].median_minutes(9).__round__(1)
    47.3
    """

    overhead: float
    per_game: float
    match_sd: float
    evening_sd: float
    level: float = 1.0
    source: str = ""

    def __post_init__(self) -> None:
        for name in ("overhead", "match_sd", "evening_sd"):
            number(getattr(self, name), name, low=0.0)
        for name in ("per_game", "level"):
            positive(getattr(self, name), name)

    def median_minutes(self, games: float) -> float:
        """Return the median time of a match of so many games."""
        return self.level * (self.overhead + self.per_game * games)


PACES: dict[str, Pace] = {
    "9-ball": Pace(3.8, 5.58, 0.275, 0.15, 0.876, _SOURCE),
    "8-ball": Pace(3.8, 9.82, 0.305, 0.15, 0.876, _SOURCE),
    "10-ball": Pace(0.8, 7.07, 0.288, 0.15, 0.876, _SOURCE),
}
"""The paces that come with the package, by discipline."""


def pace_of(discipline: str | Pace) -> Pace:
    """Return the pace of a discipline.

    Raises
    ------
    InputError
        if there is none of this name.
    """
    if isinstance(discipline, Pace):
        return discipline
    if discipline not in PACES:
        raise InputError(f"pace is {discipline!r}; give one of {', '.join(PACES)}, or a Pace")
    return PACES[discipline]


class Timed(NamedTuple):
    """A match that has been played: its games and its minutes."""

    games: int
    minutes: float


def learned_pace(pace: str | Pace, played: Sequence[Timed]) -> Pace:
    """Return the pace of this evening, learned from the matches played so far.

    Parameters
    ----------
    pace
        what was known before.
    played
        the matches of this evening with their games and minutes.

    Returns
    -------
    Pace
        its `level` is that of the evening's median pace, its `evening_sd` what is left of
        the uncertainty about it.

    Raises
    ------
    InputError
        if a match has no games or no minutes.

    Notes
    -----
    With r the logarithm of a match's minutes over its median, n matches and the variances s²
    of a match and t² of an evening, the evening's pace is normal with precision 1/t² + n/s²
    and mean (sum of r / s²) over that.

    >>> slow = learned_pace(Pace(4, 6, 0.3, 0.15), [Timed(7, 60), Timed(9, 75), Timed(5, 45)])
    >>> round(slow.level, 3), round(slow.evening_sd, 3)
    (1.122, 0.113)
    """
    before = pace_of(pace)
    if not played or not before.evening_sd:
        return before
    logs = [
        math.log(
            positive(match.minutes, "minutes")
            / before.median_minutes(positive(match.games, "games"))
        )
        for match in played
    ]
    if not before.match_sd:
        return replace(before, level=before.level * math.exp(sum(logs) / len(logs)), evening_sd=0.0)
    precision = before.evening_sd**-2 + len(logs) * before.match_sd**-2
    shift = sum(logs) * before.match_sd**-2 / precision
    return replace(before, level=before.level * math.exp(shift), evening_sd=precision**-0.5)


@dataclass(frozen=True)
class Turnover:
    """The time between two matches on a table.

    Parameters
    ----------
    mean
        minutes on average.
    at_once
        the chance that the next match begins at once; otherwise the time is exponential.

    Notes
    -----
    With the table and both players free, 62 % of real turnovers took less than a minute, and
    the mean was 4.
    """

    mean: float = 4.0
    at_once: float = 0.62

    def __post_init__(self) -> None:
        number(self.mean, "mean", low=0.0)
        number(self.at_once, "at_once", low=0.0, below=1.0)
