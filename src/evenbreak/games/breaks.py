"""Break formats: who breaks the next rack, given who broke the last one and who won it.

A format is a plain function of (breaker, winner), both 1 or 2, so a league with its own rule can
pass its own function.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

from evenbreak.checks import one_of
from evenbreak.errors import InputError

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
    """Return the next breaker, which is always player 1: a handicap."""
    return 1


def player_2_breaks(breaker: int, winner: int) -> int:  # noqa: ARG001
    """Return the next breaker, which is always player 2: a handicap."""
    return 2


BREAK_FORMATS: dict[str, BreakFormat] = {
    "winner": winner_breaks,
    "loser": loser_breaks,
    "alternate": alternate_breaks,
    "player 1": player_1_breaks,
    "player 2": player_2_breaks,
}
"""The usual formats, by name."""


def checked_format(breaks: Any) -> BreakFormat:
    """Return `breaks` if it returns the next breaker, 1 or 2, after every rack; else InputError.

    >>> checked_format(lambda breaker, winner: winner - 1)
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: breaks(1, 1), the next breaker, must be 1 or 2; you gave 0
    """
    if not callable(breaks):
        raise InputError(
            "breaks must be a break format such as winner_breaks; you gave {breaks!r}",
            breaks=breaks,
        )
    for breaker in (1, 2):
        for winner in (1, 2):
            after = breaks(breaker, winner)
            one_of(after, f"breaks({breaker}, {winner}), the next breaker,", (1, 2))
    return breaks  # type: ignore[no-any-return]
