"""Match-by-match systems like the National Pool League's, with other steps or another chart.

Steps are the same every time, or depend on the margin of the score: the further the loser was from
winning, the longer the step. If the loser needed r games and won l of them,

    points = ceil(most (r - l) / r)

so a shutout moves both players by `most`, and a hill-hill match moves them by 1 (unless r is below
`most`). What counts is the share of the loser's own race, not the number of games: the weaker
player needs fewer games and cannot lose by as many. If games counted, the stronger of two correctly
rated players would lose a fifth of a point a match at the race 5:4, and more than a point at 7:2.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from evenbreak.errors import InputError
from evenbreak.handicaps.charts.design import fixed_length_chart
from evenbreak.handicaps.systems.by_match import PlayedMatch, StepSystem, points_of
from evenbreak.handicaps.systems.npl import NPL


@dataclass(frozen=True)
class _Step:
    up: int
    down: int

    def __call__(self, match: PlayedMatch) -> tuple[int, int]:  # noqa: ARG002
        return self.up, -self.down


def step_system(up: Any, down: Any = None) -> StepSystem:
    """Return the system in which the winner goes up by `up` points and the loser down by `down`.

    The scale and charts are the National Pool League's. Newcomers move like everyone else.

    Parameters
    ----------
    up
        points, a whole number from 1 to 1,000.
    down
        points, a whole number from 0 to 1,000; None: the same as `up`. If the two differ, the
        league's mean rating moves: each match adds up - down to the sum of the two ratings.

    Raises
    ------
    InputError
        if a number is out of range.

    >>> step_system(2).rule(PlayedMatch((80, 75), (5, 3), (5, 5)))
    (2, -2)
    >>> step_system(2, 1).in_words
    'up 2 points for each match won, down 1 for each match lost'
    """
    won = points_of(up, "up")
    lost = won if down is None else points_of(down, "down", at_least=0)
    return StepSystem(
        f"step {won}" if lost == won else f"step {won} {lost}",
        NPL.scale,
        NPL.charts,
        _Step(won, lost),
        f"up {won} point{'s' * (won > 1)} for each match won, down {lost} for each match lost",
        own_chart=NPL.own_chart,
        conserving=lost == won,
    )


@dataclass(frozen=True)
class _Margin:
    most: int

    def __call__(self, match: PlayedMatch) -> tuple[int, int]:
        if match.games is None or match.race is None:
            raise InputError(
                "the score or the race is None, but steps by margin of victory need both"
            )
        needed = match.race[1]
        points = -(-self.most * (needed - match.games[1]) // needed)
        return points, -points


def margin_system(most: Any = 2) -> StepSystem:
    """Return the system whose steps depend on the margin of victory, up to `most` points.

    The scale and charts are the National Pool League's. Newcomers move like everyone else.

    Parameters
    ----------
    most
        the points for a shutout, a whole number from 1 to 1,000; 1 means a point per match.

    Raises
    ------
    InputError
        if `most` is not such a number; the rule itself raises it if the score or race is missing.

    >>> rule = margin_system(2).rule
    >>> [rule(PlayedMatch((80, 75), (5, lost), (5, 5))) for lost in (0, 2, 3, 4)]
    [(2, -2), (2, -2), (1, -1), (1, -1)]
    """
    points = points_of(most, "most")
    return StepSystem(
        f"margin {points}",
        NPL.scale,
        NPL.charts,
        _Margin(points),
        f"up to {points} point{'s' * (points > 1)} a match, depending on how much of the race the "
        "loser had left",
        own_chart=NPL.own_chart,
        asks=("games", "race"),
    )


def fixed_length_system(games: Any = 9) -> StepSystem:
    """Return the National Pool League's system with races that all have the same longest length.

    The rule, including the one for newcomers, is the same; only the chart differs:
    `fixed_length_chart(games)`.

    Parameters
    ----------
    games
        the most games that a match may last, an odd whole number up to 999.

    Raises
    ------
    InputError
        if `games` is not such a number.

    >>> fixed_length_system(7).usual_chart().race(12)
    (5, 3)
    """
    chart = fixed_length_chart(games, NPL.scale)
    longest = sum(chart.race(0)) - 1
    return replace(NPL, name=f"fixed {longest}", charts=(), own_chart=chart)
