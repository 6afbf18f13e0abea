"""Ratings from results: Bradley-Terry on games, maximum a posteriori, with standard errors."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.csgraph import connected_components

from evenbreak.errors import InputError
from evenbreak.ratings.inverse_diagonal import inverse_diagonal
from evenbreak.ratings.posterior import PairCounts, count_pairs, find_mode, hessian
from evenbreak.ratings.results import Results
from evenbreak.ratings.scale import Scale, scale_of

__all__ = ["PRIOR_SD", "Ratings", "fit"]

PRIOR_SD = math.log(2.0)
"""Default standard deviation of the prior, in natural log-odds: one doubling of the odds.

That is 30 points in the NPL and 100 of Fargo's. The NPL's own range, from beginners at 20
to professionals at 130, is four of them wide; the marginal likelihood of a season of
snooker professionals, who are nearer to each other, is highest at 0.5. It weighs as much
as eight games against an equal opponent, so after a few matches the results speak.
"""


@dataclass(frozen=True, eq=False)
class Ratings:
    """Ratings of players, in the order of `players`.

    Attributes
    ----------
    players
        the names.
    rating
        points on `scale`; a middling player of a component is at `anchor`.
    standard_error
        the posterior standard deviation of each rating (Laplace's approximation: the
        square root of the diagonal of the inverse Hessian), in points, given the model
        and the prior. It is worked out when first asked for.
    games, won, lost
        games played, won and lost by each player, without forfeits.
    component
        players who are connected through opponents share a number, from 1 for the
        largest component; across components the ratings compare nothing but the prior.
    scale, anchor, prior_sd
        the scale, the mean of the prior in points, and its standard deviation in
        natural log-odds.
    iterations, gradient
        Newton steps, and the largest entry of the log-posterior's gradient after them,
        in games.
    matches, forfeits, empty
        rows used, rows left out as forfeits, and rows left out as 0-0.
    """

    players: tuple[str, ...]
    rating: NDArray[np.float64]
    games: NDArray[np.int64]
    won: NDArray[np.int64]
    lost: NDArray[np.int64]
    component: NDArray[np.int64]
    scale: Scale
    anchor: float
    prior_sd: float
    iterations: int
    gradient: float
    matches: int
    forfeits: int
    empty: int
    _pairs: PairCounts = field(repr=False)
    _skill: NDArray[np.float64] = field(repr=False)

    @cached_property
    def standard_error(self) -> NDArray[np.float64]:
        """The posterior standard deviation of each rating, in points.

        Good to rounding for up to 2,000 players, and for more who play in divisions; for
        more who all play each other within 0.1 %, as a rule within 1e-5.
        """
        precision = self.prior_sd**-2
        variance = inverse_diagonal(hessian(self._pairs, self._skill, precision), precision)
        return np.sqrt(variance) * self.scale.points_per_log_odds

    def win_probability(self, player: str, opponent: str) -> float:
        """Return P(`player` wins a game against `opponent` | both ratings are right).

        Raises
        ------
        InputError
            if a player is not among the rated, or the two cannot be compared because no
            chain of opponents connects them.
        """
        first, second = self._position(player), self._position(opponent)
        if self.component[first] != self.component[second]:
            raise InputError(
                f"{player!r} and {opponent!r} are not connected through opponents; add results "
                "that connect them"
            )
        difference = float(self.rating[first] - self.rating[second])
        return float(self.scale.win_probability(difference))

    def _position(self, player: str) -> int:
        if player not in self.players:
            raise InputError(
                f"player {player!r} is not among the rated; give a name of the results"
            )
        return self.players.index(player)


def fit(
    results: Results,
    *,
    prior_sd: float = PRIOR_SD,
    scale: Any = "npl",
    anchor: float | None = None,
) -> Ratings:
    """Return the ratings that are most likely a posteriori, given the games of `results`.

    Every game counts alike: a match is so many games won and lost, whatever the race.
    Forfeits and 0-0 are left out and counted. A player who won (or lost) every game gets
    a finite rating from the prior.

    Parameters
    ----------
    results
        the matches.
    prior_sd
        standard deviation of the prior in natural log-odds, whatever the scale: the scale
        only rescales.
    scale
        'npl', 'fargo', 'elo', points that double the odds, or a `Scale`.
    anchor
        the prior mean in points; None is the scale's centre.

    Raises
    ------
    InputError
        if prior_sd is not in 0.001 to 100, the anchor is not finite, or a score is negative or a
        player meets himself (see `find_problems`).
    AccuracyError
        if the mode is not found to rounding.

    Notes
    -----
    Bradley & Terry (1952), "Rank analysis of incomplete block designs"; the prior after
    Caron & Doucet (2012), there gamma, here normal. A component's ratings have the mean
    `anchor` exactly.

    >>> from evenbreak.ratings import Results, fit
    >>> season = Results.from_names(["Ann", "Bo", "Cy"], ["Bo", "Cy", "Ann"], [7, 7, 3], [4, 5, 7])
    >>> ratings = fit(season, scale="fargo")
    >>> ratings.rating.round(1), ratings.standard_error.round(1)
    (array([552.3, 492. , 455.8]), array([69.4, 68.3, 68.9]))
    """
    prior_sd = _checked_sd(prior_sd)
    scale = scale_of(scale)
    anchor = scale.centre if anchor is None else float(anchor)
    if not math.isfinite(anchor):
        raise InputError(f"anchor is {anchor!r}; give a finite number of points")
    played, forfeits, empty = results.played()
    if (played.score_a < 0).any() or (played.score_b < 0).any():
        raise InputError("results hold a negative score; correct what find_problems tells")
    if (played.player_a == played.player_b).any():
        raise InputError("results hold a player against himself; correct what find_problems tells")
    pairs = count_pairs(
        len(results.players), played.player_a, played.player_b, played.score_a, played.score_b
    )
    mode = find_mode(pairs, prior_sd**-2)
    return Ratings(
        players=results.players,
        rating=anchor + scale.points_per_log_odds * mode.skill,
        games=pairs.won + pairs.lost,
        won=pairs.won,
        lost=pairs.lost,
        component=_components(pairs),
        scale=scale,
        anchor=anchor,
        prior_sd=prior_sd,
        iterations=mode.iterations,
        gradient=mode.gradient,
        matches=len(played),
        forfeits=forfeits,
        empty=empty,
        _pairs=pairs,
        _skill=mode.skill,
    )


def _checked_sd(prior_sd: Any) -> float:
    try:
        value = float(prior_sd)
    except (TypeError, ValueError):
        value = math.nan
    # Beyond these the data, or the prior, are nothing but rounding to the other.
    if not 1e-3 <= value <= 100.0:
        raise InputError(f"prior_sd is {prior_sd!r}; give a number from 0.001 to 100, in log-odds")
    return value


def _components(pairs: PairCounts) -> NDArray[np.int64]:
    """Return the component of each player, numbered from 1, the largest first."""
    number, label = connected_components(pairs.games, directed=False)
    size = np.bincount(label, minlength=number)
    # Stable, so that of equal components the one with the earlier player comes first:
    # scipy labels components in the order of their first node.
    order = np.argsort(-size, kind="stable")
    rank = np.empty(number, dtype=np.int64)
    rank[order] = np.arange(1, number + 1)
    return rank[label]
