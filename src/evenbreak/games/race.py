"""The race m:n: player 1 needs m games, player 2 needs n."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass
from typing import TYPE_CHECKING

from evenbreak.checks import whole
from evenbreak.games.match import Match, Score
from evenbreak.games.rack import ChanceT, Rack

if TYPE_CHECKING:
    from evenbreak.game import ArcArrays


@dataclass(frozen=True, repr=False)
class Race(Match[ChanceT]):
    """Race in which player 1 needs m games and player 2 needs n (P5.5, P5.6).

    Parameters
    ----------
    win_by
        player 1 wins at the score a:b if a >= m and (a - m) - (b - n) >= win_by, and
        player 2 likewise; 1 is the plain race.

    The other parameters are those of `Match`.

    Raises
    ------
    InputError
        if a parameter has an invalid value; it says which.

    >>> from evenbreak.games import Rack, winner_breaks
    >>> race = Race(3, 2, Rack(2 / 3))
    >>> race.start, race.moves((2, 1))
    ((0, 0), {(3, 1): 0.6666666666666666, (2, 2): 0.33333333333333337})
    >>> race.winner((3, 1))
    1
    >>> Race(3, 2, Rack(0.6, 0.5), breaks=winner_breaks, first_breaker=2).start
    (0, 0, 2)
    """

    _: KW_ONLY
    win_by: int = 1

    def __post_init__(self) -> None:
        object.__setattr__(self, "win_by", whole(self.win_by, "win_by", at_least=1))
        super().__post_init__()

    def decided(self, a: int, b: int) -> int | None:
        """Return who has won at the score a:b: 1, 2, or None while the race continues.

        >>> from evenbreak.games import Rack
        >>> Race(5, 4, Rack(0.5), win_by=2).decided(5, 3) is None
        True
        """
        lead = (a - self.m) - (b - self.n)
        if a >= self.m and lead >= self.win_by:
            return 1
        if b >= self.n and -lead >= self.win_by:
            return 2
        return None

    def fold(self, a: int, b: int) -> Score:
        """Return the lowest score from which the rest of the race is the same as from a:b.

        Once both players need at most `win_by` more games, only the difference between the games
        they need matters ("deuce").

        >>> from evenbreak.games import Rack
        >>> Race(5, 5, Rack(0.5), win_by=2).fold(8, 7)
        (4, 3)
        """
        spare = min(a - max(self.m - self.win_by, 0), b - max(self.n - self.win_by, 0))
        return (a - spare, b - spare) if spare > 0 else (a, b)

    def arcs(self) -> ArcArrays | None:
        """Return all states and arcs as arrays; None for sets, win-by-K, or chances in fractions.

        They are the same as those of `moves`, but made without a Python loop over the states.

        >>> from evenbreak.games import Rack
        >>> len(Race(100, 100, Rack(0.5)).arcs().states)
        10200
        >>> Race(3, 3, Rack(0.5), win_by=2).arcs() is None
        True
        """
        if self.win_by > 1 or not isinstance(self.rack, Rack) or self.rack.in_fractions:
            return None
        from evenbreak.games.race_arcs import race_arcs

        return race_arcs((self.m, self.n), self.rack, self.breaks, self.first_breaker, self.score)
