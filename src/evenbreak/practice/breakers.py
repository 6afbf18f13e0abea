"""Who breaks, rack after rack without end: two states, and who wins in each of them."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from evenbreak.errors import InputError
from evenbreak.games.breaks import BreakFormat, checked_format
from evenbreak.games.rack import Rack


class Breakers(NamedTuple):
    """The two states of endless play (who breaks the rack), for arrays of probabilities.

    >>> from evenbreak.games import winner_breaks
    >>> breakers = Breakers.of(0.75, 0.5, winner_breaks)
    >>> [float(fraction) for fraction in breakers.broken(1)]
    [0.6666666666666666, 0.3333333333333333]
    """

    win_1: Any  # player 1 wins, given that 1 breaks
    lose_1: Any
    win_2: Any  # player 1 wins, given that 2 breaks
    lose_2: Any
    pass_1: Any  # the break passes from 1 to 2
    pass_2: Any
    pulls: tuple[int, int]  # by breaker: player 1's next breaks after a win less those after a loss

    @classmethod
    def of(cls, p1: Any, p2: Any, breaks: BreakFormat) -> Breakers:
        """Return the states for two probabilities and a break format; all are checked."""
        rack = Rack(p1, p2)
        checked_format(breaks)
        if p2 is None:
            raise InputError("p2 is missing; give P(player 2 wins a rack that player 2 breaks)")
        one, two = np.broadcast_arrays(rack.chance(1, 1), rack.chance(2, 2))
        lose_1, win_2 = 1.0 - one, 1.0 - two
        return cls(
            one,
            lose_1,
            win_2,
            two,
            one * (breaks(1, 1) == 2) + lose_1 * (breaks(1, 2) == 2),
            win_2 * (breaks(2, 1) == 1) + two * (breaks(2, 2) == 1),
            (
                (breaks(1, 1) == 1) - (breaks(1, 2) == 1),
                (breaks(2, 1) == 1) - (breaks(2, 2) == 1),
            ),
        )

    def broken(self, first_breaker: int) -> tuple[Any, Any]:
        """Return the fractions of the racks that player 1 and player 2 break."""
        changes = self.pass_1 + self.pass_2
        stays = changes == 0.0
        per_change = np.where(stays, 1.0, changes)
        return (
            np.where(stays, float(first_breaker == 1), self.pass_2 / per_change),
            np.where(stays, float(first_breaker == 2), self.pass_1 / per_change),
        )

    def won(self, first_breaker: int) -> Any:
        """Return the fraction of the racks that player 1 wins."""
        first, second = self.broken(first_breaker)
        return first * self.win_1 + second * self.win_2

    def lost(self, first_breaker: int) -> Any:
        """Return the fraction that player 1 loses, accurate even if it is tiny."""
        first, second = self.broken(first_breaker)
        return first * self.lose_1 + second * self.lose_2

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of p1 and p2 together."""
        return np.shape(self.win_1)

    @property
    def first_break(self) -> Any:
        """(r_1 - r_2) / (a + b): infinite if the break never passes on."""
        edge, changes = self.win_1 - self.win_2, self.pass_1 + self.pass_2
        stays = changes == 0.0
        endless = np.where(edge == 0.0, 0.0, np.copysign(math.inf, edge))
        return np.where(stays, endless, edge / np.where(stays, 1.0, changes))
