"""Steps: each match moves the winner up and the loser down by the same points every time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

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

    Scale and charts are those of the National Pool League. Newcomers move like everybody else.

    Parameters
    ----------
    up
        points, a whole number from 1 to 1,000.
    down
        points, a whole number from 0 to 1,000; None: as many as `up`. With another number the
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
