"""Endless play as two states (who breaks), and who wins the rack in each of them."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from evenbreak.checks import one_of
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

    win: tuple[Any, Any]  # by breaker: player 1 wins the rack
    lose: tuple[Any, Any]
    passes: tuple[Any, Any]  # by breaker: the break passes to the other player
    # By breaker: player 1's chance to break next after winning, minus that after losing.
    pulls: tuple[int, int]

    @classmethod
    def of(cls, p1: Any, p2: Any, breaks: BreakFormat) -> Breakers:
        """Return the states for two probabilities and a break format; all are checked."""
        rack = Rack(p1, p2)
        checked_format(breaks)
        if p2 is None:
            raise InputError("p2 is missing; give P(player 2 wins a rack that player 2 breaks)")
        one, two = np.broadcast_arrays(rack.chance(1, 1), rack.chance(2, 2))
        win, lose = (one, rack.chance(1, 2)), (rack.chance(2, 1), two)
        passes = (
            win[0] * (breaks(1, 1) == 2) + lose[0] * (breaks(1, 2) == 2),
            win[1] * (breaks(2, 1) == 1) + lose[1] * (breaks(2, 2) == 1),
        )
        pulls = (
            (breaks(1, 1) == 1) - (breaks(1, 2) == 1),
            (breaks(2, 1) == 1) - (breaks(2, 2) == 1),
        )
        return cls(win, lose, passes, pulls)

    @property
    def changes(self) -> Any:
        """P(the break passes from 1 to 2) plus P(it passes back)."""
        return self.passes[0] + self.passes[1]

    def broken(self, first_breaker: int) -> tuple[Any, Any]:
        """Return the fractions of the racks that player 1 and player 2 break."""
        one_of(first_breaker, "first_breaker", (1, 2))
        stays = self.changes == 0.0
        per_change = np.where(stays, 1.0, self.changes)
        return (
            np.where(stays, float(first_breaker == 1), self.passes[1] / per_change),
            np.where(stays, float(first_breaker == 2), self.passes[0] / per_change),
        )

    def won(self, first_breaker: int) -> Any:
        """Return the fraction of the racks that player 1 wins."""
        first, second = self.broken(first_breaker)
        return first * self.win[0] + second * self.win[1]

    def lost(self, first_breaker: int) -> Any:
        """Return the fraction of the racks that player 1 loses, accurate even if it is tiny."""
        first, second = self.broken(first_breaker)
        return first * self.lose[0] + second * self.lose[1]

    @property
    def first_break(self) -> Any:
        """(r_1 - r_2) / (a + b): infinite if the break never passes on."""
        edge, changes = self.win[0] - self.win[1], self.changes
        stays = changes == 0.0
        endless = np.where(edge == 0.0, 0.0, np.copysign(math.inf, edge))
        return np.where(stays, endless, edge / np.where(stays, 1.0, changes))
