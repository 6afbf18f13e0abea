r"""All final scores of a match between two rated players, in one table by rating difference.

At the difference x of two ratings the chart gives the race m:n. A match ends m:k with k < n, or
k:n with k < m, and the update rule gives the points that each such score moves the two players.
If p is the chance that player 1 wins a game, and q = 1 - p,

    P(m:k) = C(m - 1 + k, k) p^m q^k        P(k:n) = C(n - 1 + k, k) q^n p^k

so ladders and leagues need only this table and p.

Source: problem P5.5 (the chances of the final scores), Table 5.6 (charts).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import gammaln, xlogy

from evenbreak.arrays import Bools, Floats, Ints, Places, array_values
from evenbreak.checks import complement, probability, whole
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.chart_of import chart_of
from evenbreak.handicaps.systems.by_match import PlayedMatch, StepSystem
from evenbreak.matches.win import race_win_probability

NOBODY = -1
"""Filler for `games` if a race has fewer final scores than the table has room for."""

_DOUBLINGS = 2.0
"""Default width of a table: up to where the odds of a game are 4 to 1."""


@array_values
@dataclass(frozen=True, eq=False)
class MatchTable:
    """All final scores of a system's matches, by rating difference; see `match_table`.

    The first axis is the rating difference x, player 1's rating minus player 2's, from -widest to
    widest. The moves are for established players; newcomers' moves are multiplied by the factors in
    `System.newcomer_steps`.

    Parameters
    ----------
    widest
        the largest difference, in points.
    needs
        shape (2 * widest + 1, 2): the race m:n.
    games
        shape (2 * widest + 1, outcomes, 2): the games of each final score: first player 1's wins
        (m:0, m:1, ..., m:n - 1), then player 2's (0:n, ..., m - 1:n), then -1:-1 as padding.
    moves
        shape (2 * widest + 1, outcomes, 2): the points that player 1 and player 2 move; 0 in
        the padding.
    won
        shape (2 * widest + 1, outcomes): whether player 1 wins with this score.

    >>> from evenbreak.handicaps import chart, system_of
    >>> table = match_table(system_of("npl"), chart("npl_8"), widest=10)
    >>> table.needs[table.widest + 7].tolist()
    [4, 3]
    >>> table.games[table.widest + 7].tolist()
    [[4, 0], [4, 1], [4, 2], [0, 3], [1, 3], [2, 3], [3, 3], [-1, -1]]
    >>> table.chances(0.5)[table.widest + 7].round(3).tolist()
    [0.062, 0.125, 0.156, 0.125, 0.188, 0.188, 0.156, 0.0]
    """

    system: StepSystem
    chart: Chart
    widest: int
    needs: Ints
    games: Ints
    moves: Ints
    won: Bools

    def wins(self, p: ArrayLike) -> Floats:
        """Return P(player 1 wins the match | rating difference, chance p of winning a game).

        Parameters
        ----------
        p
            P(player 1 wins a game), of any shape.

        Returns
        -------
        numpy.ndarray
            shape (2 * widest + 1,) followed by that of p.

        Raises
        ------
        InputError
            if p is not a probability.

        >>> from evenbreak.handicaps import chart, system_of
        >>> match_table(system_of("npl"), chart("npl_10"), widest=6).wins(0.5)[[0, 6, 12]].round(3)
        array([0.637, 0.5  , 0.363])
        """
        game = np.asarray(probability(p, "p"))
        first, place = self.races
        down = (slice(None), *(None,) * game.ndim)
        m, n = self.needs[first].T
        by_race = np.asarray(race_win_probability(game, m[down], n[down]))
        return by_race[place]

    def chances(self, p: ArrayLike) -> Floats:
        """Return P(each final score | rating difference, player 1's chance p of winning a game).

        Parameters
        ----------
        p
            P(player 1 wins a game), of any shape.

        Returns
        -------
        numpy.ndarray
            shape (2 * widest + 1, outcomes) followed by that of p; 0 in the padding. The chances
            of all scores add up to 1.

        Raises
        ------
        InputError
            if p is not a probability.
        """
        game = np.asarray(probability(p, "p"))
        first, place = self.races
        games, won = np.maximum(self.games[first], 0), self.won[first]
        a, b = games[..., 0], games[..., 1]
        # The winner wins the last game; only the games before it can be in any order.
        before, lost = np.maximum(np.where(won, a, b) - 1, 0), np.where(won, b, a)
        orders = gammaln(before + lost + 1) - gammaln(before + 1) - gammaln(lost + 1)
        down = (..., *(None,) * game.ndim)
        log = orders[down] + xlogy(a[down], game) + xlogy(b[down], complement(game))
        by_race = np.where((a + b > 0)[down], np.exp(log), 0.0)
        return by_race[place]

    @cached_property
    def races(self) -> tuple[Places, Places]:
        """The first place of each race in the table, and the race at each difference."""
        _, first, place = np.unique(self.needs, axis=0, return_index=True, return_inverse=True)
        return first, place.reshape(-1)


def match_table(
    system: StepSystem, chart: Chart | str | None = None, *, widest: Any = None
) -> MatchTable:
    """Return all final scores of a system's matches, by rating difference.

    Parameters
    ----------
    chart
        default: the system's own.
    widest
        the largest difference in points, a whole number from 1 up; None: two doublings of the
        odds, 60 points in the National Pool League.

    Raises
    ------
    InputError
        if a parameter is invalid, or the rule does not return a pair of
        whole points.

    >>> from evenbreak.handicaps import system_of
    >>> match_table(system_of("step 2")).moves[60].tolist()[4:6]
    [[2, -2], [-2, 2]]
    """
    if not isinstance(system, StepSystem):
        raise InputError(
            "{system} must be a StepSystem, such as system_of('npl'); you gave {value!r}",
            value=system,
        )
    by = system.usual_chart() if chart is None else chart_of(chart)
    wanted = round(_DOUBLINGS * system.scale.points_per_doubling) if widest is None else widest
    size = whole(wanted, "widest", at_least=1)
    needs = np.column_stack(by.races(np.arange(-size, size + 1)))
    games, won = _scores(needs)
    tables = (needs, games, _moves(system, needs, games, won), won)
    for table in tables:
        table.setflags(write=False)
    return MatchTable(system, by, size, *tables)


known_table = lru_cache(maxsize=8)(match_table)
"""`match_table` with a cache of the last tables, which are read-only."""


def _scores(needs: Ints) -> tuple[Ints, Bools]:
    """Return the final scores of each race, and which of them player 1 wins."""
    m, n = needs[:, 0, None], needs[:, 1, None]
    place = np.arange(needs.sum(axis=1).max())
    won = place < n
    real = place < m + n
    a = np.where(won, m, place - n)
    b = np.where(won, place, n)
    return np.where(real[..., None], np.stack([a, b], axis=2), NOBODY), won


def _moves(system: StepSystem, needs: Ints, games: Ints, won: Bools) -> Ints:
    moves = np.zeros_like(games)
    size = len(needs) // 2
    for place, outcome in np.argwhere(games[..., 0] != NOBODY).tolist():
        turn = 1 if won[place, outcome] else -1
        apart = float(turn * (place - size))
        m, n = needs[place].tolist()[::turn]
        mine, theirs = games[place, outcome].tolist()[::turn]
        points = system.moves(PlayedMatch((apart, 0.0), (mine, theirs), (m, n)))
        moves[place, outcome] = points[::turn]
    return moves
