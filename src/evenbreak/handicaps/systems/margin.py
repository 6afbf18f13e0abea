"""Steps by the margin of the score: the further the loser was from winning, the longer the step.

If the loser needed r games and won l of them,

    points = ceil(most (r - l) / r)

so a shutout moves both players by `most`, and a match that goes hill-hill by 1 (unless r is below
`most`). What counts is the share of the loser's own race, not games: the weaker player needs
fewer games and cannot lose by as many. If games counted, the stronger of two correctly rated
players would lose a fifth of a point a match at the race 5:4, and more than a point at 7:2.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from evenbreak.errors import InputError
from evenbreak.handicaps.systems.by_match import PlayedMatch, StepSystem, points_of
from evenbreak.handicaps.systems.npl import NPL


@dataclass(frozen=True)
class _Margin:
    most: int

    def __call__(self, match: PlayedMatch) -> tuple[int, int]:
        if match.games is None or match.race is None:
            raise InputError(
                "the score or the race is None; steps by the margin of the score need both"
            )
        needed = match.race[1]
        points = -(-self.most * (needed - match.games[1]) // needed)
        return points, -points


def margin_system(most: Any = 2) -> StepSystem:
    """Return the system whose steps depend on the margin of the score, up to `most` points.

    Scale and charts are those of the National Pool League. Newcomers move like everybody else.

    Parameters
    ----------
    most
        the points of a shutout, a whole number from 1 to 1,000; 1 is a point a match.

    Raises
    ------
    InputError
        if `most` is not such a number; from its rule, if score or race is missing.

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
        f"up to {points} point{'s' * (points > 1)} a match, by the share of the loser's race left",
        own_chart=NPL.own_chart,
        asks=("games", "race"),
    )
