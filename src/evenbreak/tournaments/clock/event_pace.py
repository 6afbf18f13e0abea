"""A whole event's pace: calibrated to real events, adjusted to earlier nights and to tonight.

The model is the one in `evenbreak.matches.pace`: a match takes (overhead + per_game games) N A
minutes, where the match's luck N and the evening's pace A are lognormal with mean 1. Half of the
variance of log A is due to the venue: it is the same on all evenings there, and the uncertainty
about it shrinks with each night learned. Tonight's matches give a normal posterior for log A.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Annotated, NamedTuple

from msgspec import Meta

from evenbreak.checks import kind_of, positive
from evenbreak.matches.pace import Pace, pace_of

_EVENTS = {"8-ball": (0.97, 0.12), "9-ball": (0.97, 0.12), "10-ball": (0.895, 0.09)}
"""Multipliers for the pace of single matches in an event, and how much evenings vary.

They are calibrated, not derived; docs/explanation/brackets.md explains how. As in that calibration,
rounds wait for each other.
"""
_VENUE = 0.5  # of the variance of the pace of evenings
_PRIOR_NIGHTS = 2.0  # that what is usual counts as, against the nights of a venue
SLOWEST = 2.0
"""How much longer or shorter than usual a night can be and still say something about the pace."""
QUICKEST = 1.5
"""The fewest minutes per game: a shorter match was called late, or entered afterward."""


@dataclass(frozen=True)
class EarlierNight:
    """An earlier tournament at the same venue.

    Parameters
    ----------
    at
        when its first match was called, such as 2025-03-01T19:30:00.
    discipline
        8-ball, 9-ball or 10-ball.
    ratio
        its duration divided by the median expected at the usual pace.
    """

    at: str
    discipline: str
    ratio: Annotated[float, Meta(ge=1.0 / SLOWEST, le=SLOWEST)]


def nights_of(discipline: str, earlier: Iterable[EarlierNight]) -> list[EarlierNight]:
    """Return a discipline's nights: other disciplines' say nothing about its pace."""
    return [one for one in earlier if one.discipline == discipline]


def venue_ratio(nights: Sequence[EarlierNight], prior_nights: float = _PRIOR_NIGHTS) -> float:
    """Return the ratio of a venue's match times to the usual ones, from nights in one discipline.

    `prior_nights` nights at the usual pace are added; 0 gives the plain average.

    >>> venue_ratio([EarlierNight("2025-03-01T19:30:00", "9-ball", 1.21)] * 2).__round__(3)
    1.1
    """
    logs = [math.log(one.ratio) for one in nights]
    return math.exp(sum(logs) / (len(logs) + prior_nights))


def event_pace(pace: Pace | str, earlier: Iterable[EarlierNight] = ()) -> Pace:
    """Return a whole event's pace: a discipline's calibrated pace, or a given pace.

    Parameters
    ----------
    pace
        a discipline, or a `Pace`, which is returned unchanged.
    earlier
        nights at the same venue. If y are the logarithms of the ratios for the n nights in this
        discipline, the venue's matches take exp(sum y / (n + 2)) times as long as usual, and 2 / (n
        + 2) of the variance between venues remains in `evening_sd`.

    Raises
    ------
    InputError
        if there is no such discipline.

    >>> event_pace("9-ball").mean_minutes(9).__round__(2)
    52.4
    >>> slow = [EarlierNight("2025-03-01T19:30:00", "9-ball", 1.2)] * 4
    >>> event_pace("9-ball", slow).mean_minutes(9).__round__(2)
    59.03
    """
    if not isinstance(pace, str):
        return kind_of(pace, "pace", Pace)
    usual = pace_of(pace)
    level, usual_sd = _EVENTS[pace]
    nights = nights_of(pace, earlier)
    not_known = 1.0 - _VENUE + _VENUE * _PRIOR_NIGHTS / (len(nights) + _PRIOR_NIGHTS)
    evening_sd = usual_sd * math.sqrt(not_known)
    # The ratios are of middles, and the pace is a mean.
    level *= venue_ratio(nights) * math.exp((evening_sd**2 - usual_sd**2) / 2.0)
    return replace(_times(usual, level), evening_sd=evening_sd)


def _times(pace: Pace, factor: float) -> Pace:
    scaled = {"overhead": factor * pace.overhead, "per_game": factor * pace.per_game}
    return replace(pace, **scaled, discipline=None)


class Timed(NamedTuple):
    """A match that has been played: its games and its minutes."""

    games: int
    minutes: float


def learned_pace(pace: Pace | str, played: Sequence[Timed]) -> Pace:
    """Return this evening's pace, adjusted to the matches played so far.

    Parameters
    ----------
    pace
        the pace assumed before: a discipline, or a `Pace`.
    played
        this evening's matches with their games and minutes.

    Returns
    -------
    Pace
        its `evening_sd` is the remaining uncertainty about the evening.

    Raises
    ------
    InputError
        if a match has no games or no minutes.

    Notes
    -----
    If r is the logarithm of a match's minutes divided by their mean, n is the number of matches,
    and s² and t² are the variances of a match and of an evening, then log A is normal with
    precision 1/t² + n/s² and mean (-1/2 + sum of (r + s²/2) / s²) divided by that.

    >>> slow = learned_pace(Pace(4, 6, 0.3, 0.15), [Timed(7, 60), Timed(9, 75), Timed(5, 45)])
    >>> round(slow.per_game, 2), round(slow.evening_sd, 3)
    (6.86, 0.113)
    """
    before = event_pace(pace)
    if not played or not before.evening_sd:
        return before
    logs = [
        math.log(
            positive(match.minutes, "minutes") / before.mean_minutes(positive(match.games, "games"))
        )
        for match in played
    ]
    if not before.match_sd:
        return replace(_times(before, math.exp(sum(logs) / len(logs))), evening_sd=0.0)
    variance = 1.0 / (before.evening_sd**-2 + len(logs) * before.match_sd**-2)
    seen = sum(logs) * before.match_sd**-2 + len(logs) / 2.0
    mean = variance * (seen - 0.5)
    learned = _times(before, math.exp(mean + variance / 2.0))
    return replace(learned, evening_sd=math.sqrt(variance))
