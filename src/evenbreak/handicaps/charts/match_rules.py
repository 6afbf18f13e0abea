"""How matches are won and who breaks, and the chance and length of each race at each difference.

Arrays have races down and differences across: shape (races, differences). Plain races have
closed forms. With X the games that player 1 wins of the first k, if all of them were played,

    W(p; m, n) = I_p(m, n)
    E[games]   = (m / p) I_p(m + 1, n) + (n / q) I_q(n + 1, m)
    P(games <= k) = P(X >= m) + P(k - X >= n),  k < m + n - 1

(the mean follows from k C(k - 1, m - 1) = m C(k, m)). Races that must be won by more than one
game, or in which the break matters, are solved one by one.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import betainc

from evenbreak.arrays import Floats
from evenbreak.checks import number, whole
from evenbreak.errors import InputError
from evenbreak.games.breaks import BreakFormat
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.handicaps.charts.audit import even_doublings
from evenbreak.matches.length import match_length
from evenbreak.matches.quantiles import TIE
from evenbreak.matches.win import race_win_probability, win_probability
from evenbreak.ratings.scale import Scale, scale_of

_MOST_DOUBLINGS = 24.0
"""Every race is even at fewer doublings of the odds than this: 1000:1 at 10.5."""


@dataclass(frozen=True)
class MatchRules:
    """How the matches of a league are won, who breaks, and what ratings mean.

    Parameters
    ----------
    scale
        what rating differences mean: 'npl', 'fargo', 'elo', a `Scale`, or the points that
        double the odds.
    win_by
        by how many games a race must be won; 1 for the plain race.
    breaks
        who breaks next; needed where `break_points` is not 0.
    break_points
        what the break is worth: the breaker plays like somebody rated that many points
        higher (lower, if negative). Either player breaks first with chance 1/2.

    Raises
    ------
    InputError
        if a parameter is out of range.

    >>> rules = MatchRules("npl")
    >>> rules.win([4, 2], [2, 1], [0, 30]).round(3).tolist()
    [[0.188, 0.461], [0.25, 0.444]]
    """

    scale: Any
    win_by: int = 1
    breaks: BreakFormat | None = None
    break_points: float = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "scale", scale_of(self.scale))
        object.__setattr__(self, "win_by", whole(self.win_by, "win_by", at_least=1))
        number(self.break_points, "break_points")
        if self.break_points and self.breaks is None:
            raise InputError(
                "breaks is missing: with break_points the break matters; give winner_breaks, ..."
            )

    @property
    def points(self) -> float:
        """The rating points that double the odds of a game."""
        scale: Scale = self.scale
        return scale.points_per_doubling

    @property
    def is_plain(self) -> bool:
        """Whether a match is a plain race in which the break does not matter."""
        return self.win_by == 1 and not self.break_points

    def win(self, m: ArrayLike, n: ArrayLike, differences: ArrayLike) -> Floats:
        """Return P(player 1 wins m:n | player 1 is rated higher by each of the differences).

        Parameters
        ----------
        m, n
            the games that player 1 and player 2 need, shape (races,).
        differences
            rating points, shape (differences,).

        Returns
        -------
        array of shape (races, differences)
        """
        points = np.asarray(differences, dtype=float)
        if self.is_plain:
            chances = self.scale.win_probability(points)
            return np.asarray(race_win_probability(chances, *_columns(m, n)))
        return np.array(
            [
                np.mean([win_probability(match) for match in self._matches(one, two, points)], 0)
                for one, two in _pairs(m, n)
            ]
        )

    def mean_games(self, m: ArrayLike, n: ArrayLike, differences: ArrayLike) -> Floats:
        """Return the mean length in games, as `win` does."""
        points = np.asarray(differences, dtype=float)
        if not self.is_plain:
            return np.array(
                [
                    np.mean([match_length(one).mean for one in self._matches(*race, points)], 0)
                    for race in _pairs(m, n)
                ]
            )
        p, q = self.scale.win_probability(points), self.scale.win_probability(-points)
        m, n = _columns(m, n)
        return np.asarray(m * betainc(m + 1, n, p) / p + n * betainc(n + 1, m, q) / q)

    def ends_within(self, m: ArrayLike, n: ArrayLike, differences: ArrayLike, games: int) -> Floats:
        """Return P(the match takes at most `games` games), as `win` does."""
        points = np.asarray(differences, dtype=float)
        if not self.is_plain:
            return np.array(
                [self._ended(*race, points)[:, : games + 1].sum(axis=1) for race in _pairs(m, n)]
            )
        p, q = self.scale.win_probability(points), self.scale.win_probability(-points)
        m, n = _columns(m, n)
        won_1 = np.where(m <= games, betainc(m, np.maximum(games - m + 1, 1), p), 0.0)
        won_2 = np.where(n <= games, betainc(n, np.maximum(games - n + 1, 1), q), 0.0)
        return np.where(m + n - 1 <= games, 1.0, won_1 + won_2)

    def games_quantile(self, m: int, n: int, differences: ArrayLike, q: float) -> NDArray[Any]:
        """Return the smallest number of games within which m:n ends with chance q.

        Returns
        -------
        array of shape (differences,), of whole numbers
        """
        ended = np.cumsum(self._ended(m, n, np.asarray(differences, dtype=float)), axis=1)
        return np.asarray((ended >= q * (1.0 - TIE)).argmax(axis=1))

    def even_differences(self, m: ArrayLike, n: ArrayLike) -> Floats:
        """Return the differences at which the races are even, in points; shape (races,)."""
        if self.is_plain:
            return np.asarray(self.points * even_doublings(m, n), dtype=float)
        return np.array([self._even_difference(*race) for race in _pairs(m, n)])

    def _even_difference(self, m: int, n: int) -> float:
        """Find where W passes through 1/2, by grids within grids."""
        if m == n:
            return 0.0
        least = -_MOST_DOUBLINGS * self.points
        low, width = least, -2.0 * least
        for _ in range(4):
            grid = np.linspace(low, low + width, 129)
            above = int((self.win([m], [n], grid)[0] >= 0.5).argmax())
            low, width = float(grid[max(above - 1, 0)]), width / 128.0
        return low + width / 2.0

    def _matches(self, m: int, n: int, points: Floats) -> list[Race]:
        """Return the race at all differences, once for each possible first breaker."""
        if not self.break_points:
            return [Race(m, n, self.scale.rack(points), win_by=self.win_by)]
        own = self.scale.rack(points + self.break_points)
        other = self.scale.rack(self.break_points - points)
        rack = Rack(own.p1, other.p1, q1=own.q1, q2=other.q1)
        return [
            Race(m, n, rack, breaks=self.breaks, first_breaker=first, win_by=self.win_by)
            for first in (1, 2)
        ]

    def _ended(self, m: int, n: int, points: Floats) -> Floats:
        """Return P(the match takes k games), shape (differences, games from 0 on)."""
        lengths = [match_length(match) for match in self._matches(m, n, points)]
        ended = np.zeros((points.size, max(length.span for length in lengths) + 1))
        for length in lengths:
            ended[:, length.games] += length.probability / len(lengths)
        return ended


def match_rules(rules: Any) -> MatchRules:
    """Return `rules` if it is a `MatchRules`, else those of plain races on that scale.

    >>> match_rules("fargo").points
    100.0
    """
    return rules if isinstance(rules, MatchRules) else MatchRules(rules)


def _columns(m: ArrayLike, n: ArrayLike) -> tuple[NDArray[Any], NDArray[Any]]:
    return np.asarray(m)[:, np.newaxis], np.asarray(n)[:, np.newaxis]


def _pairs(m: ArrayLike, n: ArrayLike) -> Iterable[tuple[int, int]]:
    return zip(np.asarray(m).tolist(), np.asarray(n).tolist(), strict=True)
