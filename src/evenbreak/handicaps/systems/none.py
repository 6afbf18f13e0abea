"""No handicap: every match is the same even race, and no rating moves."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.checks import whole
from evenbreak.handicaps.systems.history import Entries, History
from evenbreak.handicaps.systems.system import System


@dataclass(frozen=True)
class NoHandicap(System):
    """Even races to `games` for everyone, regardless of ratings.

    >>> NoHandicap(5).race([700.0, 500.0], 600.0)
    (array([5, 5]), array([5, 5]))
    """

    games: int = 5
    name: str = "none"

    winner_never_falls = True

    def __post_init__(self) -> None:
        whole(self.games, "games", at_least=1)

    @property
    def in_words(self) -> str:  # type: ignore[override]
        """The rule in words."""
        return f"every match is an even race to {self.games}; ratings stay as they are"

    def initial(self, entries: Entries) -> Floats:
        """Return the list's ratings, or 0 for a player without one."""
        return np.nan_to_num(np.where(np.isnan(entries.rating), entries.level, entries.rating))

    def race(self, a: Any, b: Any) -> tuple[Ints, Ints]:
        """Return the same even race for every pair."""
        shape = np.broadcast_shapes(np.shape(a), np.shape(b))
        return np.full(shape, self.games), np.full(shape, self.games)

    def update(self, history: History) -> Floats:
        """Return the ratings unchanged."""
        return np.array(history.ratings)
