"""Endless play: rack after rack in one break format, without a final score."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass

from evenbreak.checks import one_of
from evenbreak.errors import InputError
from evenbreak.games.breaks import BreakFormat, checked_format
from evenbreak.games.rack import Rack, game_repr


@dataclass(frozen=True)
class Series:
    """An endless series of racks in one break format (P5.24).

    Parameters
    ----------
    breaks
        who breaks next (see `evenbreak.games.breaks`).
    first_breaker
        who breaks the first rack, 1 or 2.

    Raises
    ------
    InputError
        if a parameter has an invalid value; it says which.

    Notes
    -----
    State i: player i breaks next. The long-run reward of `series.rack.chance(1, state)` is the
    fraction of racks that player 1 wins.

    >>> from evenbreak.games import Rack, winner_breaks
    >>> Series(Rack(0.75, 0.5), breaks=winner_breaks).moves(1)
    {1: 0.75, 2: 0.25}
    """

    rack: Rack
    _: KW_ONLY
    breaks: BreakFormat
    first_breaker: int = 1

    def __repr__(self) -> str:
        return game_repr(self)

    def __post_init__(self) -> None:
        if not isinstance(self.rack, Rack):
            raise InputError(
                "rack must be a Rack(p) or a Rack(p1, p2); you gave {rack!r}", rack=self.rack
            )
        self.rack.of_numbers()
        checked_format(self.breaks)
        first = one_of(self.first_breaker, "first_breaker", (1, 2))
        object.__setattr__(self, "first_breaker", first)

    @property
    def start(self) -> int:
        """The first breaker."""
        return self.first_breaker

    def moves(self, state: int) -> Mapping[int, float]:
        """Return the probability of each next breaker, given that player `state` breaks now."""
        by_winner = {winner: self.breaks(state, winner) for winner in (1, 2)}
        if by_winner[1] == by_winner[2]:
            return {by_winner[1]: 1.0}
        return {
            breaker: chance
            for winner, breaker in by_winner.items()
            if (chance := self.rack.move(winner, state)) > 0.0
        }

    def winner(self, state: int) -> None:  # noqa: ARG002
        """Return None: an endless series has no winner."""
        return
