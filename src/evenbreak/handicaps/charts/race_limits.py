"""Which races a chart may hold."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from evenbreak.checks import whole
from evenbreak.errors import InputError


def games_range(games: Any) -> tuple[int, int]:
    """Return the pair (lo, hi) if it holds two whole numbers, the smaller first.

    >>> games_range((5, 7))
    (5, 7)
    """
    if not isinstance(games, tuple | list) or len(games) != 2:
        raise InputError(f"games is {games!r}; give the pair (lo, hi)")
    low, high = (whole(limit, "games", at_least=1) for limit in games)
    if low > high:
        raise InputError(f"games is {games!r}; give the smaller number first")
    return low, high


@dataclass(frozen=True)
class RaceLimits:
    """Which races a chart may hold.

    Parameters
    ----------
    games
        (lo, hi): the races m:n whose longest match, m + n - 1 games, has lo to
        hi games.
    stronger_least, weaker_least
        the fewest games that the stronger and the weaker player may need. The stronger
        player never needs fewer than the weaker.
    games_p90
        the number of games within which 9 of 10 matches must end, at every difference;
        None for no such limit.

    Raises
    ------
    InputError
        if a limit is not a whole number from 1 up, `lo` is above `hi`, or no even race is
        left.

    >>> RaceLimits((5, 7), weaker_least=3).races
    ((3, 3), (4, 3), (4, 4), (5, 3))
    """

    games: tuple[int, int]
    stronger_least: int = 1
    weaker_least: int = 1
    games_p90: int | None = None

    def __post_init__(self) -> None:
        low, high = games_range(self.games)
        object.__setattr__(self, "games", (low, high))
        for name in ("stronger_least", "weaker_least"):
            object.__setattr__(self, name, whole(getattr(self, name), name, at_least=1))
        if self.games_p90 is not None:
            object.__setattr__(self, "games_p90", whole(self.games_p90, "games_p90", at_least=1))
        least = max(self.stronger_least, self.weaker_least)
        if max(least, (low + 2) // 2) > (high + 1) // 2:
            shortest = max(2 * least - 1, low + 1 - low % 2)
            raise InputError(
                f"games is {self.games!r}, which leaves no even race to {least} or more; give a "
                f"second number of {shortest} or more"
            )

    @property
    def races(self) -> tuple[tuple[int, int], ...]:
        """The races (m, n), m for the stronger player, the shortest first."""
        low, high = self.games
        return tuple(
            (m, longest + 1 - m)
            for longest in range(low, high + 1)
            for m in range(
                max(self.stronger_least, longest // 2 + 1), longest + 2 - self.weaker_least
            )
        )
