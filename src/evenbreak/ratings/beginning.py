"""What is expected of players before a file's first result.

The skill of player i, in natural log-odds, has the prior

    θi = mi + Zi b + ei,    ei ~ N(0, σ²),    bk ~ N(0, sk²),

with a known mean m, and levels b, one for each team or division, which are estimated with the
skills. A row of Z says which levels a player belongs to. Integrating b out would leave players
of one team correlated; kept as unknowns, levels are only further nodes of the graph of play.

Earlier results may be known too. A rating r with the standard error s, made with a prior N(m, σ²),
says the same about the skill θ as results with the information

    J = 1/s² - 1/σ²    and    Jx = r/s² - m/σ²

: a likelihood proportional to exp(-J θ²/2 + Jx θ). This information is carried over, so that the
new season may have another prior, and so that old results fade with a half-life like any others. A
rating that was not made from results has no such prior: J = 1/s². Of a list that states games and
no errors, n games say J = n/4 (a game between equals says p (1 - p)); the variance of such a list's
other errors, b², is the same for all its ratings, so that J = 1/(b² + 4/n).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Bools, Floats, array_values
from evenbreak.checks import column, names, number
from evenbreak.errors import InputError
from evenbreak.ratings.decay import day_of
from evenbreak.ratings.results import Results
from evenbreak.ratings.roster import error_of_games
from evenbreak.ratings.scale import DEFAULT_SCALE, Scale, scale_of


class Known(NamedTuple):
    """What is known about a file's players beforehand: information J and pull Jx, in log-odds."""

    information: Floats
    pull: Floats


@array_values
@dataclass(frozen=True, eq=False, init=False)
class Beginning:
    """Ratings that players bring with them.

    Parameters
    ----------
    players
        the names, each once.
    rating
        points.
    standard_error
        the uncertainty of each rating, in points. The uncertainty of a difference is computed as
        the root of the sum of two squares, so use quasi-standard errors where there are any. NaN
        where it is unknown; it then follows from the games and `Levels.brought_sd`.
    prior_sd, prior_mean
        the standard deviation and the means of the prior used to make the ratings, in points; a
        standard deviation of NaN or None means that they were not made from results.
    games
        the number of games behind each rating, 0 where it is unknown; None: all 0. It gives the
        uncertainty of ratings without a standard error, and how much of a newcomer each player
        still is.
    as_of
        the date of the ratings; None: the day before the first result.

    Raises
    ------
    InputError
        if a number is not finite, or an error is not above 0 or is above the prior's.

    >>> old = Beginning(["Ann", "Bo"], [95, 70], [10, 30], scale="npl", prior_sd=30, prior_mean=80)
    >>> known = old.known(["Bo", "Ann", "Cy"])
    >>> known.information.round(3), known.pull.round(3)
    (array([ 0.   , 16.651,  0.   ]), array([0.  , 5.53, 0.  ]))
    """

    players: tuple[str, ...]
    rating: Floats
    standard_error: Floats
    scale: Scale
    prior_sd: Floats
    prior_mean: Floats
    games: Floats
    as_of: np.datetime64 | None

    def __init__(
        self,
        players: Sequence[str],
        rating: ArrayLike,
        standard_error: ArrayLike | None = None,
        *,
        scale: Any = DEFAULT_SCALE,
        prior_sd: float | ArrayLike | None = None,
        prior_mean: float | ArrayLike | None = None,
        games: ArrayLike | None = None,
        as_of: Any = None,
    ) -> None:
        known = names(players, "players")
        many = len(known)
        center = scale_of(scale).center
        for name, given, missing in (
            ("rating", rating, np.nan),
            ("standard_error", standard_error, np.nan),
            ("prior_sd", prior_sd, np.nan),
            ("prior_mean", prior_mean, center),
            ("games", games, 0.0),
        ):
            values = missing if given is None else given
            spread = np.full(many, values) if np.ndim(values) == 0 else values
            object.__setattr__(self, name, column(spread, name, many, "players"))
        if not np.isfinite(self.rating).all() or not np.isfinite(self.prior_mean).all():
            raise InputError("rating and prior_mean must be finite numbers of points; some aren't")
        for name in ("standard_error", "prior_sd"):
            values = getattr(self, name)
            if (values <= 0.0).any() or np.isinf(values).any():
                raise InputError(
                    "{name} must have numbers of points above 0, or NaN if unknown; one isn't "
                    "above 0",
                    name=name,
                )
        object.__setattr__(self, "players", known)
        object.__setattr__(self, "scale", scale_of(scale))
        object.__setattr__(self, "as_of", None if as_of is None else day_of(as_of))

    def center(self, players: Sequence[str]) -> float:
        """Return the mean of the ratings that some players bring with them, in points.

        The new ratings are centered on it; if no player brings a rating, it is the scale's center.
        """
        here = set(players)
        brought = [r for name, r in zip(self.players, self.rating, strict=True) if name in here]
        return float(np.mean(brought)) if brought else self.scale.center

    def anchor(self, players: Sequence[str], scale: Scale, *, brought: bool) -> float | None:
        """Return the `center` if the ratings count and are on this scale, else None.

        `brought` says whether ratings without a standard error count.
        """
        counts = brought or not np.isnan(self.standard_error).all()
        return self.center(players) if counts and self.scale.same_points(scale) else None

    @property
    def by_games(self) -> Bools:
        """Which ratings have a number of games but no stated uncertainty."""
        return np.asarray(np.isnan(self.standard_error) & (self.games > 0.0))

    @property
    def unknown_error(self) -> bool:
        """Whether any rating has no stated uncertainty."""
        return bool(np.isnan(self.standard_error).any())

    def known(self, players: Sequence[str], *, brought_sd: float = 0.0) -> Known:
        """Return what is known about the given players, looked up by name.

        Parameters
        ----------
        players
            the names. Their skills are counted from `center`.
        brought_sd
            the error of ratings without a standard error, in natural log-odds, in addition to what
            follows from their number of games; 0: such ratings are not used.

        >>> old = Beginning(["Ann"], [95], games=[200])
        >>> old.known(["Ann"], brought_sd=0.1).information.round(1)
        array([33.3])
        """
        unit = self.scale.log_odds(1.0)
        zero = self.center(players)
        error = np.where(np.isnan(self.standard_error), np.nan, self.standard_error * unit)
        if brought_sd:
            besides = number(brought_sd, "brought_sd")
            of_games = np.where(
                self.by_games, unit * error_of_games(self.games, self.scale, np.inf), 0.0
            )
            error = np.where(np.isnan(error), np.hypot(besides, of_games), error)
        precision = np.nan_to_num(error**-2.0)
        prior = np.where(precision > 0.0, np.nan_to_num((self.prior_sd * unit) ** -2.0), 0.0)
        precision += np.where(self.by_games, prior, 0.0)  # games alone say nothing of a prior
        pull = precision * (self.rating - zero) * unit - prior * (self.prior_mean - zero) * unit
        information = precision - prior
        # An error as large as the prior's says nothing.
        said = information > 1e-9 * np.maximum(precision, 1.0)
        return Known(
            *(self._of(players, np.where(said, figure, 0.0)) for figure in (information, pull))
        )

    def kept(self, half_life: float | None, results: Results, day: np.datetime64 | None) -> float:
        """Return the fraction of their weight that the ratings still have on a given day.

        Parameters
        ----------
        half_life
            in days; None: results always count in full.
        results
            the new results; ratings without a date are treated as being from just before the first
            one.
        day
            the day; None: the day of the last result.
        """
        if half_life is None or results.date is None:
            return 1.0
        dated = results.date[~np.isnat(results.date)]
        if not len(dated):
            return 1.0
        begun = dated.min() if self.as_of is None else self.as_of
        age = ((dated.max() if day is None else day) - begun) / np.timedelta64(1, "D")
        return float(np.exp2(-max(age, 0.0) / half_life))

    def games_of(self, players: Sequence[str]) -> Floats:
        """Return the number of games behind each given player's rating, 0 for unknown players."""
        return self._of(players, self.games)

    def _of(self, players: Sequence[str], values: Floats) -> Floats:
        place = {name: k for k, name in enumerate(self.players)}
        at = [place.get(name, -1) for name in players]
        return np.append(values, 0.0)[at]


@dataclass(frozen=True, eq=False)
class PriorMeans:
    """Prior mean of each player, and the levels that players share, in natural log-odds.

    `design` is each player's share of each level, shape (players, levels); `level_sd` is the
    standard deviation of a level's own prior, about 0. `known` is the evidence about the skills
    from earlier results, and `follow` is what other players' skills add to the means (see `at`).
    """

    mean: Floats
    design: Floats
    level_sd: Floats
    names: tuple[tuple[str, str], ...] = ()
    known: Known | None = None
    follow: Callable[[Floats], Floats] | None = None

    @classmethod
    def none(cls, players: int) -> PriorMeans:
        """Return the prior for a league about which nothing is known: all means are 0."""
        return cls(np.zeros(players), np.zeros((players, 0)), np.zeros(0))

    @property
    def precision(self) -> Floats:
        """The prior precision of each level."""
        return np.asarray(self.level_sd**-2.0)

    def centered(self, among: Floats) -> PriorMeans:
        """Return the same prior, shifted so that some players' means have a weighted average of 0.

        If all weights are 0, nothing changes.

        >>> known = PriorMeans(np.array([0.0, 0.6]), np.array([[1.0], [0.0]]), np.array([0.5]))
        >>> known.centered(np.ones(2)).mean, known.centered(np.ones(2)).design.ravel()
        (array([-0.3,  0.3]), array([ 0.5, -0.5]))
        """
        total = float(among.sum())
        if total == 0.0:
            return self
        share, follow = among / total, self.follow

        def centered(skill: Floats) -> Floats:
            above = np.zeros(len(skill)) if follow is None else follow(skill)
            return np.asarray(above - share @ above)

        return replace(
            self,
            mean=self.mean - share @ self.mean,
            design=self.design - share @ self.design,
            follow=None if follow is None else centered,
        )

    def at(self, skill: Floats) -> PriorMeans:
        """Return the same prior, given the skills of the players whom others follow."""
        if self.follow is None:
            return self
        return replace(self, mean=self.mean + self.follow(skill), follow=None)

    def faded(self, keep: float) -> PriorMeans:
        """Return the same prior, with earlier results reduced to a fraction of their weight."""
        if self.known is None or keep == 1.0:
            return self
        return replace(self, known=Known(*(keep * figure for figure in self.known)))

    @property
    def information(self) -> Floats:
        """How much earlier results add to the precision of each skill."""
        return np.zeros(len(self.mean)) if self.known is None else self.known.information

    def expected(self, level: Floats) -> Floats:
        """Return each player's mean, given the levels."""
        return np.asarray(self.mean + self.design @ level)

    def log_density(self, skill: Floats, level: Floats, precision: float) -> float:
        """Return the log of the prior density of skills and levels, up to a constant.

        `precision` is 1/σ².
        """
        miss = skill - self.expected(level)
        prior = -0.5 * (precision * float(miss @ miss) + float(self.precision @ level**2))
        if self.known is None:
            return prior
        return prior + float((self.known.pull - 0.5 * self.known.information * skill) @ skill)

    def slopes(self, skill: Floats, level: Floats, precision: float) -> tuple[Floats, Floats]:
        """Return the gradient of the negative log density in the skills and in the levels."""
        pull = precision * (skill - self.expected(level))
        of_level = self.precision * level - self.design.T @ pull
        if self.known is not None:
            pull = pull + self.known.information * skill - self.known.pull
        return pull, of_level


STILL = 1e-3
"""Tolerance between two routes to the same skills where means follow: 1/7 of a Fargo point."""

MOST_MOVES = 40
"""How many times the means are updated from the skills at most."""


class MovingMeans:
    """Means that follow the skills while the mode is searched for, until they no longer move.

    The means move the mode, and the mode moves the means, by less each time: by about the fraction
    of known players' skills that still comes from their prior. The means are left alone once the
    remaining movement is at most half of `STILL`, assuming that moves keep shrinking by half or as
    the last one did.
    """

    def __init__(self, means: PriorMeans) -> None:
        self._whole, self.now = means, means
        self._moves, self._moved = 0, 2.0 * STILL
        # The levels of divisions and teams move along, which in the end takes more rounds.
        self._times = 8.0 if len(means.level_sd) else 1.0

    def follow(self, skill: Floats) -> bool:
        """Return whether the means moved with the skills."""
        if self._whole.follow is None:
            return False
        before, self.now = self.now, self._whole.at(skill)
        self._moves += 1
        if before.follow is None:
            last, self._moved = self._moved, float(np.abs(self.now.mean - before.mean).max())
            share = min(self._moved / last, 0.99) if last else 0.0
            left = self._moved * max(share / (1.0 - share), self._times)
            if left <= 0.5 * STILL or self._moves == MOST_MOVES:
                self._whole = self.now
        return True
