"""The n-ahead match m:n: player 1 wins by leading by m games, player 2 by leading by n."""

from __future__ import annotations

from dataclasses import dataclass

from evenbreak.games.match import Match, Score
from evenbreak.games.rack import ChanceT


@dataclass(frozen=True, repr=False)
class Ahead(Match[ChanceT]):
    """n-ahead match: player 1 needs a lead of m games, player 2 a lead of n (P5.27, Fig. 5.10).

    Only the lead matters, so the score of a state is the lead: (2, 0) means that player 1
    leads by two games, (0, 1) that player 2 leads by one. The parameters are those of `Match`.

    Raises
    ------
    InputError
        if a parameter is invalid; it says which.

    >>> from evenbreak.games import Rack
    >>> match = Ahead(5, 3, Rack(0.75))
    >>> match.moves((0, 2))
    {(0, 1): 0.75, (0, 3): 0.25}
    >>> match.winner((0, 3))
    2
    """

    def decided(self, a: int, b: int) -> int | None:
        """Return who has won at the score a:b: 1, 2, or None while the match continues."""
        if a - b >= self.m:
            return 1
        return 2 if b - a >= self.n else None

    def fold(self, a: int, b: int) -> Score:
        """Return the lead as a score: games that both players have are subtracted."""
        common = min(a, b)
        return a - common, b - common
