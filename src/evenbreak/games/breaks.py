"""Break formats: who breaks the next rack, given who broke the last one and who won it.

A format is a plain function of (breaker, winner), both 1 or 2, so a league with a
rule of its own passes its own function.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

__all__ = [
    "BREAK_FORMATS",
    "BreakFormat",
    "alternate_breaks",
    "loser_breaks",
    "player_1_breaks",
    "player_2_breaks",
    "winner_breaks",
]

BreakFormat: TypeAlias = Callable[[int, int], int]


def winner_breaks(breaker: int, winner: int) -> int:  # noqa: ARG001
    """Return the next breaker: whoever won the last rack (P5.24)."""
    return winner


def loser_breaks(breaker: int, winner: int) -> int:  # noqa: ARG001
    """Return the next breaker: whoever lost the last rack (P5.24)."""
    return 3 - winner


def alternate_breaks(breaker: int, winner: int) -> int:  # noqa: ARG001
    """Return the next breaker: whoever did not break the last rack (P5.24)."""
    return 3 - breaker


def player_1_breaks(breaker: int, winner: int) -> int:  # noqa: ARG001
    """Return the next breaker: player 1, always; a handicap."""
    return 1


def player_2_breaks(breaker: int, winner: int) -> int:  # noqa: ARG001
    """Return the next breaker: player 2, always; a handicap."""
    return 2


BREAK_FORMATS: dict[str, BreakFormat] = {
    "winner": winner_breaks,
    "loser": loser_breaks,
    "alternate": alternate_breaks,
    "player 1": player_1_breaks,
    "player 2": player_2_breaks,
}
"""The usual formats by name."""
