"""Rating gap between two players whose ratings have errors: chances, lengths and fair races.

The difference between two ratings is known only up to an error: it is distributed as N(d, e²), with
the estimate d and the standard error e. A chance W(p(δ); m, n) is then averaged over the possible
differences δ,

    E W = ∫ W(p(d + e z); m, n) φ(z) dz,

by Gauss-Hermite quadrature. That pulls chances toward 1/2: the plug-in value, W at the estimate
itself, is overconfident about the favorite. Day-to-day form (`evenbreak.matches.form`) is one more
error, which is drawn again for each match.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats, Ints
from evenbreak.checks import floats, plain, probability, together, whole
from evenbreak.errors import InputError
from evenbreak.games.match import Match
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.handicaps.charts.fair import Candidate, FairRace, longest_matches, shortest_of_ties
from evenbreak.matches.form import center_of_form, form_of, given_score, normal_rule, rule_for
from evenbreak.matches.length import MatchLength, match_length
from evenbreak.matches.odds import MatchOdds, match_odds, mixed_odds
from evenbreak.matches.parameters import checked_match, with_rack
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.scale import DEFAULT_SCALE, Scale, scale_of

MOST_DOUBLINGS = 10.0
"""The largest standard error allowed, in multiples of the difference that doubles the odds."""

MOST_RACES = 20_000
"""Limit of the search for the closest races: all races of up to 200 games."""

_MOST_NODES = 20_000
_TIE = 1e-9
_AT_A_TIME = 1 << 20  # values held in memory at once


@dataclass(frozen=True, eq=False)
class Gap:
    """Player 1's rating minus player 2's, its uncertainty, and the resulting chances.

    Parameters
    ----------
    difference
        rating of player 1 minus rating of player 2, in points; a number, or an array of many pairs.
    error
        the standard error of that difference, in points; 0 treats the ratings as exact. For two
        independent ratings, it is the root of the sum of their squared errors. It is broadcast with
        `difference`.
    scale
        the scale of the points: a name, points that double the odds, or a `Scale`.
    form
        how much the log-odds of a game vary from match to match (standard deviation), independent
        of the scale. Form does not change the chance of a single game.

    Raises
    ------
    InputError
        if a number is not finite, an error is negative or more than ten doublings of the odds,
        form is not in 0 to 3, or the shapes do not broadcast.

    Notes
    -----
    The number of nodes grows with the error and with the length of the race, so that the
    quadrature is off by less than 1e-9, except in races of hundreds of games between almost unknown
    players.

    >>> round(Gap(60).win(7, 3), 4), round(Gap(60, error=40).win(7, 3), 4)
    (0.7382, 0.6485)
    >>> Gap([91, -91], scale="fargo").fair_races(race_to=7)
    (array([7, 4]), array([4, 7]))
    """

    difference: Any
    error: Any = 0.0
    scale: Any = DEFAULT_SCALE
    form: float = 0.0

    def __post_init__(self) -> None:
        scale = scale_of(self.scale)
        most = MOST_DOUBLINGS * scale.points_per_doubling
        wanted = f"0 to {most:g} points ({MOST_DOUBLINGS:g} doublings of the odds)"
        difference = floats(self.difference, "difference")
        error = floats(self.error, "error", low=0.0, high=most, wanted=wanted)
        together(difference=difference, error=error)
        difference, error = np.broadcast_arrays(difference, error)
        for name, checked in (
            ("scale", scale),
            ("difference", difference),
            ("error", error),
            ("form", form_of(self.form)),
        ):
            object.__setattr__(self, name, checked)

    def __getitem__(self, pairs: Any) -> Gap:
        """Return the gaps for some of the pairs."""
        return replace(self, difference=self.difference[pairs], error=self.error[pairs])

    def at(self, difference: Any) -> Gap:
        """Return the gap for a pair with this difference and the same uncertainty."""
        return replace(self, difference=difference)

    @property
    def taken_as_right(self) -> Gap:
        """The same gap without rating error; form is kept."""
        return replace(self, error=0.0)

    @property
    def p_game(self) -> Any:
        """P(player 1 wins a game): a float for a single pair, otherwise an array."""
        return replace(self, form=0.0).win(1, 1)

    @cached_property
    def normal(self) -> tuple[Floats, Floats]:
        """The differences and errors, in points, that combine error and day-to-day form.

        Both are normal, so their variances add up. The chance of a game is the same as without
        form.
        """
        if self.form == 0.0:
            return self.difference, self.error
        mean, sd = self.scale.log_odds(self.difference), self.scale.log_odds(self.error)
        center, around = center_of_form(mean, sd, self.form), np.hypot(sd, self.form)
        return np.asarray(self.scale.points(center)), np.asarray(self.scale.points(around))

    def _rule(self, longest: int) -> tuple[Floats, Floats]:
        """Return nodes and weights that average W over the errors, for races of this many games."""
        _, around = self.normal
        return averaging_rule(float(around.max(initial=0.0)), longest, self.scale)

    def win(self, m: ArrayLike, n: ArrayLike) -> Any:
        """Return P(player 1 wins the race m:n | the ratings and their standard error).

        Returns
        -------
        float or numpy.ndarray
            a float for numbers, otherwise an array.

        Raises
        ------
        InputError
            if m or n is not a whole number, or the shapes do not broadcast.

        >>> Gap([0, 60], error=40).win(7, [7, 3]).round(4).tolist()
        [0.5, 0.6485]
        """
        together(difference=self.difference, m=m, n=n)
        center, around, m, n = np.broadcast_arrays(*self.normal, m, n)
        nodes, weights = self._rule(int(np.max(m + n, initial=2)))
        chance = np.zeros(center.shape)
        for node, weight in zip(nodes, weights, strict=True):
            p = self.scale.win_probability(center + node * around)
            chance += weight * race_win_probability(p, m, n)
        return plain(chance)

    def length(self, m: int, n: int) -> MatchLength[Any, Any]:
        """Return the length of the race m:n, the same race for all differences.

        The chance of each length is averaged over the possible differences; mean, standard
        deviation and quantiles are those of the averaged distribution.

        >>> length = Gap([0, 60], error=40).length(7, 3)
        >>> length.mean.round(2), length.quantile(0.9)
        (array([5.75, 7.25]), array([9, 9]))
        """
        m, n = whole(m, "m", at_least=1), whole(n, "n", at_least=1)
        center, around = self.normal
        nodes, weights = self._rule(m + n)
        games = np.arange(min(m, n), m + n)
        total: Floats = np.zeros((*center.shape, len(games)))
        for node, weight in zip(nodes, weights, strict=True):
            length = match_length(Race(m, n, self.scale.rack(center + node * around)))
            # The shortest lengths are missing where their chance is 0.
            total[..., length.games - games[0]] += weight * length.probability
        mean = total @ games
        sd = np.sqrt(((games - mean[..., np.newaxis]) ** 2 * total).sum(axis=-1))
        never = plain(np.zeros(center.shape))
        return MatchLength(games, total, plain(mean), plain(sd), never, never, bounded=True)

    def odds(self, match: Match) -> MatchOdds:
        """Return the odds for a match, averaged over the uncertainty in one pair's difference.

        Parameters
        ----------
        match
            the match; its chance of winning a game is replaced by the chance from the ratings.

        Raises
        ------
        InputError
            if the gap holds many pairs, or the break matters in the match.

        Notes
        -----
        The lengths for all possible differences are mixed, and mean, standard deviation and
        quantiles are those of the mixture. The current score does not change the ratings, unless
        there is form: then it shows how well both are playing today.

        >>> from evenbreak.games import Race, Rack
        >>> round(Gap(60, error=40).odds(Race(7, 3, Rack(0.5))).p_win_1, 4)
        0.6485
        """
        match = checked_match(match)
        difference = self._of_one_pair()
        if match.break_matters:
            raise InputError(
                "the break matters in this match, but ratings don't show who breaks well. Leave "
                "out p2."
            )
        if not self.error and not self.form:
            return match_odds(with_rack(match, Rack(self.scale.win_probability(difference))))
        center, around = self.normal
        nodes, weights = rule_for(match, self.scale.log_odds(float(around)))
        many = with_rack(match, Rack(self.scale.win_probability(center + nodes * around)))
        return mixed_odds(many, given_score(many, weights) if self.form else weights)

    def _of_one_pair(self) -> float:
        if self.difference.ndim:
            raise InputError(
                "difference must be a single number, for one pair of players; its shape is {shape}",
                shape=self.difference.shape,
            )
        return float(self.difference)

    def fair_races(
        self,
        *,
        games: tuple[int, int] | None = None,
        race_to: int | None = None,
        target: float = 0.5,
    ) -> tuple[Ints, Ints]:
        """Return (m, n), two arrays: the race closest to the target for each difference.

        Among races that are equal to within 1e-9, the shortest is taken, then the one with the
        smaller m, as in `fair_races`.

        Parameters
        ----------
        games, race_to, target
            as for `fair_races`.

        Raises
        ------
        InputError
            if a parameter is out of range, or not exactly one of `games` and `race_to` is given.

        >>> Gap([91, -91, 91], [0, 0, 80], "fargo").fair_races(race_to=7)
        (array([7, 4, 7]), array([4, 7, 4]))
        """
        target = float(probability(target, "target"))
        low, high = longest_matches(games, race_to)
        if race_to is not None:
            return self._fairest_race_to(low, target)
        center, around = (part.reshape(-1) for part in self.normal)
        nodes, weights = self._rule(high + 1)
        m, longest = np.empty(center.size, dtype=np.int64), np.empty(center.size, dtype=np.int64)
        step = max(1, _AT_A_TIME // (len(nodes) * (high + 2)))
        for first in range(0, center.size, step):
            part = slice(first, first + step)
            p = self.scale.win_probability(center[part] + nodes[:, np.newaxis] * around[part])
            m[part], longest[part] = _nearest(p, weights, low, high, target)
        shape = self.difference.shape
        return m.reshape(shape), (longest + 1 - m).reshape(shape)

    def _fairest_race_to(self, needs: int, target: float) -> tuple[Ints, Ints]:
        """Return (m, n) where the stronger player needs a given number of games, the other no more.

        The stronger player's chance rises with the games that the other needs, so the race closest
        to the target is found by bisection.
        """
        center, around = self.normal
        ahead = center >= 0.0
        wanted = np.where(ahead, target, 1.0 - target)
        stronger = Gap(np.abs(center), around, self.scale)

        def away(fewer: Ints) -> Floats:
            return np.asarray(stronger.win(needs, fewer) - wanted)

        below, above = np.ones(center.shape, dtype=np.int64), np.full(center.shape, needs)
        while (above - below > 1).any():
            middle = (below + above) // 2
            enough = away(middle) >= 0.0
            below, above = np.where(enough, below, middle), np.where(enough, middle, above)
        fewer = np.where(np.abs(away(above)) < np.abs(away(below)) - _TIE, above, below)
        return np.where(ahead, needs, fewer), np.where(ahead, fewer, needs)

    def nearest_races(
        self,
        *,
        games: tuple[int, int] | None = None,
        race_to: int | None = None,
        target: float = 0.5,
        top: int = 5,
    ) -> list[FairRace]:
        """Return the races in which player 1's chance is closest to `target`, closest first.

        The first race is that of `Gap.fair_races`.

        Parameters
        ----------
        games, race_to, target, top
            as for `fair_races`.

        Raises
        ------
        InputError
            if a parameter is out of range, the gap holds many pairs, not exactly one of `games` and
            `race_to` is given, or there are more than 20,000 races to choose from.

        >>> for race in Gap(91, 80, "fargo").nearest_races(race_to=7, top=2):
        ...     print(race.race_1, race.race_2, round(race.p_win_1, 3), round(race.mean_games, 2))
        7 4 0.512 8.06
        7 3 0.372 6.81
        """
        difference = self._of_one_pair()
        target, top = probability(target, "target"), whole(top, "top", at_least=1)
        low, high = longest_matches(games, race_to)
        if race_to is not None:
            stronger, weaker = np.full(low, low), np.arange(1, low + 1)
            m, n = (stronger, weaker) if difference >= 0.0 else (weaker, stronger)
        else:
            if (many := (high * (high + 1) - low * (low - 1)) // 2) > MOST_RACES:
                raise InputError(
                    "games {low}..{high} allows {many:,} races; the limit is {most_races:,}. "
                    "Give a narrower range.",
                    low=low,
                    high=high,
                    many=many,
                    most_races=MOST_RACES,
                )
            longest = np.repeat(np.arange(low, high + 1), np.arange(low, high + 1))
            m = np.concatenate([np.arange(1, games + 1) for games in range(low, high + 1)])
            n = longest + 1 - m
        away = np.abs(self.win(m, n) - target).tolist()
        nearest = shortest_of_ties(
            sorted(
                Candidate(miss, needs_1 + needs_2 - 1, needs_1, needs_2)
                for miss, needs_1, needs_2 in zip(away, m.tolist(), n.tolist(), strict=True)
            )
        )
        races = []
        for _, _, needs_1, needs_2 in nearest[:top]:
            length = self.length(needs_1, needs_2)
            races.append(
                FairRace(
                    *(needs_1, needs_2, self.win(needs_1, needs_2)),
                    *(length.mean, length.quantile(0.9) or 0),
                )
            )
        return races


def averaging_rule(largest_error: float, longest: int, scale: Scale) -> tuple[Floats, Floats]:
    """Return nodes and weights that average W over N(0, 1) to 1e-9, using at most 20,000."""
    return normal_rule(scale.log_odds(largest_error), longest, _MOST_NODES)


def _nearest(p: Floats, weights: Floats, low: int, high: int, target: float) -> tuple[Ints, Ints]:
    """Return m and m + n - 1 of the best race for each column of p, shape (nodes, pairs).

    `row[m]` is W(p; m, n) for the races with one m + n - 1, from m = 0 (player 1 has won) on.
    """
    pairs = np.arange(p.shape[1])
    best = np.full(p.shape[1], math.inf)
    best_m, best_longest = np.zeros(p.shape[1], dtype=np.int64), np.zeros_like(pairs)
    row = np.stack([np.ones_like(p), np.zeros_like(p)])
    for longest in range(1, high + 1):
        inner = p * row[:-1] + (1.0 - p) * row[1:]
        row = np.concatenate([row[:1], inner, row[-1:]])
        if longest < low:
            continue
        away = np.abs(np.einsum("k,mkj->mj", weights, inner) - target)
        # The first of those that tie.
        place = (away <= away.min(axis=0) + _TIE).argmax(axis=0)
        miss = away[place, pairs]
        better = miss < best - _TIE
        best = np.where(better, miss, best)
        best_m = np.where(better, place + 1, best_m)
        best_longest = np.where(better, longest, best_longest)
    return best_m, best_longest
