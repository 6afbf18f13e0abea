"""Fitted ratings, with their uncertainty."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import KW_ONLY, dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from evenbreak.arrays import Bools, Floats, Ints, own_arrays
from evenbreak.errors import InputError
from evenbreak.ratings.beginning import PriorMeans
from evenbreak.ratings.covariance import Curvature, PairCounts
from evenbreak.ratings.estimates import SURE, Estimate
from evenbreak.ratings.levels import Levels, newness
from evenbreak.ratings.likelihood_terms import LikelihoodTerms
from evenbreak.ratings.provisional import established_from, is_provisional
from evenbreak.ratings.scale import Scale

if TYPE_CHECKING:
    import pandas as pd


class Group(NamedTuple):
    """Level of a team or division relative to the average one, before its players' results.

    Parameters
    ----------
    kind, name
        'team' or 'division', and its name.
    above, standard_error
        points.
    """

    kind: str
    name: str
    above: float
    standard_error: float


@dataclass(frozen=True)
class DayForm:
    """Day-to-day form in a league.

    Parameters
    ----------
    variance
        v in squared log-odds, with its 95% interval, which may start below 0.
    """

    variance: Estimate
    races: int

    @property
    def sd(self) -> float:
        """The standard deviation of form in a match, in log-odds."""
        return math.sqrt(self.variance.value)

    @property
    def sd_error(self) -> float:
        """The standard error of `sd`."""
        return self.variance.standard_error / (2.0 * self.sd) if self.sd else math.inf

    @property
    def established(self) -> bool:
        """Whether the variance is above 0 with 99% confidence."""
        return self.variance.errors_above() > SURE

    @property
    def used(self) -> float:
        """The standard deviation, rounded as in lists of ratings; 0 if it is not established."""
        return round(self.sd, 4) if self.established else 0.0


@own_arrays
@dataclass(frozen=True, eq=False)
class Ratings:
    """Ratings of players, in the order of `players`.

    Attributes
    ----------
    rating
        points on `scale`; an average player of a component is at `anchor`, unless
        `named` says otherwise.
    games, won, lost
        games played, won and lost by each player, without forfeits, each counted once regardless of
        age.
    component
        the number of each player's component, from 1 for the largest; players connected through
        opponents share a component, and ratings from different components cannot be compared.
    scale, anchor, prior_sd
        the scale, the prior's mean in points, and its standard deviation in natural log-odds.
    iterations, gradient
        Newton steps, and the log-posterior's largest slope after them, in games.
    matches, forfeits, empty, races_won, races_lost
        rows used, left out as forfeits, and left out as 0-0; and each player's matches won and
        lost that are known by race and winner alone.
    named
        players whose ratings anchor their components, and these.
    half_life, as_of, later
        days after which a match counts half, or None; the day rated for, or None; number of rows
        after that day.
    break_advantage
        how many points better the breaker of a rack plays; None if the break does not matter.
    break_games, levels
        the weighted number of games whose breaker is known, if the break matters; how much
        newcomers, teams and divisions differ beforehand.
    weight
        the number of games, and of matches known only by their winner, weighted by age.
    match_form
        how much players vary from match to match, as far as it is taken into account: the standard
        deviation of a game's log-odds. With form, a match says less than its games alone would.
    form
        the estimate of form, if it was estimated (see `day_form`).
    games_behind
        the games that each rating rests on: those played, what matches known by their winner alone
        are worth in games, and those behind a rating that was brought along.
    least_games
        how many of these games a player needs to be ranked in lists; None: see `established_from`.
    """

    players: tuple[str, ...]
    rating: Floats
    games: Ints
    won: Ints
    lost: Ints
    component: Ints
    scale: Scale
    anchor: float
    prior_sd: float
    iterations: int
    gradient: float
    matches: int
    forfeits: int
    empty: int
    _: KW_ONLY
    races_won: Ints
    races_lost: Ints
    weight: float
    match_form: float = 0.0
    named: tuple[tuple[str, float], ...] = ()
    half_life: float | None = None
    as_of: np.datetime64 | None = None
    later: int = 0
    break_advantage: float | None = None
    break_games: float = 0.0
    levels: Levels = field(default_factory=Levels)
    form: DayForm | None = None
    games_behind: Floats
    least_games: int | None = None
    _played: PairCounts | LikelihoodTerms = field(repr=False)
    _skill: Floats = field(repr=False)
    _break_precision: float | None = field(default=None, repr=False)
    _means: PriorMeans | None = field(default=None, repr=False)
    _level: Floats = field(default_factory=lambda: np.zeros(0), repr=False)

    def __repr__(self) -> str:
        return (
            f"<Ratings of {len(self.players):,} players from {self.matches:,} matches, "
            f"{self.scale.name} scale>"
        )

    @property
    def established_from(self) -> int:
        """The games needed to be ranked in lists."""
        known = self.least_games
        return established_from(self.games_behind) if known is None else known

    @cached_property
    def provisional(self) -> Bools:
        """Which ratings rest on too few games to be ranked in lists."""
        return is_provisional(self.games_behind, self.established_from)

    def strongest_first(self, players: Iterable[int] | None = None) -> list[int]:
        """Return players in list order, as positions in `players`.

        Ranked players come first, then those whose ratings are provisional, both from strongest to
        weakest and then by name. `players` are the players to list; None: all.
        """
        # Rounded in log-odds, so that neither the scale nor the last bits decide.
        strength = np.round(self.scale.log_odds(self.rating - self.anchor), 9)
        provisional = self.provisional
        chosen = range(len(self.players)) if players is None else players
        return sorted(chosen, key=lambda k: (provisional[k], -strength[k], k))

    def to_frame(self) -> pd.DataFrame:
        """Return every player's rating as a DataFrame, in the order of `strongest_first`.

        Its columns are those of ratings.csv: player; rating, standard_error and quasi_error in
        points of the scale; games, won and lost in the matches that were used; races_won and
        races_lost, if only the winner of some matches is known; component, which is the same for
        players linked by a chain of opponents, who can be compared; provisional; match_form, if it
        is not 0; and scale: its name, or the points that double the odds.

        >>> from evenbreak.ratings import Results, fit
        >>> ratings = fit(Results.from_names(["Ann"], ["Bo"], [50], [70]), scale="fargo")
        >>> ratings.to_frame()[["player", "rating", "games"]].round(1)
          player  rating  games
        0     Bo   523.4    120
        1    Ann   476.6    120
        """
        import pandas as pd

        order = self.strongest_first()
        columns = ["rating", "standard_error", "quasi_error", "games", "won", "lost"]
        columns += ["races_won", "races_lost"] if self.races_won.any() else []
        columns += ["component", "provisional"]
        return pd.DataFrame(
            {
                "player": [self.players[k] for k in order],
                **{name: np.asarray(getattr(self, name))[order] for name in columns},
                **({"match_form": self.match_form} if self.match_form else {}),
                "scale": self.scale.text,
            }
        )

    @property
    def idle(self) -> Bools:
        """Which players have no result that counts, so that their rating is the prior's."""
        return np.asarray(self.games + self.races_won + self.races_lost == 0)

    @cached_property
    def standard_error(self) -> Floats:
        """The posterior standard deviation of each rating, in points.

        Laplace's approximation: the square root of the diagonal of the inverse Hessian,
        given the model and the prior. If a component is anchored to named players, it is the
        standard deviation of the difference from their mean. It is exact to rounding for up to
        2,000 players, and for more if they play in divisions; for more players who all play each
        other, it is within 0.1%, usually within 1e-5. For more than 5,000 players in clubs that
        meet, it is sampled, with the error `error_of_errors`.
        """
        variance = self._variance.copy()
        for members, level in self._levels():
            shared = self._curvature.times(level)
            beside = variance[members] - 2.0 * shared[members] + level @ shared
            variance[members] = np.maximum(beside, 0.0)
        return np.sqrt(variance) * self.scale.points_per_log_odds

    @property
    def error_of_errors(self) -> float:
        """Relative error of the least certain standard error.

        It is 0 if the standard errors are not sampled (see `evenbreak.ratings.sampled_diagonal`).
        """
        return self._curvature.given_levels.relative_error / 2.0

    @cached_property
    def quasi_error(self) -> Floats:
        """The uncertainty of each rating in comparisons, in points: quasi-standard errors.

        The standard error of the difference of two ratings of one component is close to the
        root of the sum of the squares of these two, as if the ratings were independent. Use
        quasi-standard errors where a list has room for one error per player; `difference_error` is
        exact. They do not depend on where a component is anchored. For a player alone in a
        component, the quasi-standard error is the prior's standard deviation.

        Notes
        -----
        After Firth & de Menezes (2004), "Quasi-variances", Biometrika 91, who fit them to all
        differences. Here they follow directly. If m is the mean rating of a component of n players,

            q = var(θ - m) n / (n - 1).

        The mean of q₁ + q₂ over the pairs of a component is then exactly the mean variance of
        their differences. For n = 2, the variance of the only pair is exact.

        >>> from evenbreak.ratings import Results, fit
        >>> ratings = fit(Results.from_names(["Ann"], ["Bo"], [70], [50]), scale="fargo")
        >>> ratings.quasi_error.round(1), float(np.hypot(*ratings.quasi_error).round(1))
        (array([18.5, 18.5]), 26.2)
        """
        size = np.bincount(self.component)[self.component]
        with_mean = self._curvature.with_means(self.component)
        of_mean = np.bincount(self.component, with_mean)[self.component] / size
        around = np.maximum(self._variance - 2.0 * with_mean + of_mean, 0.0)
        share = around * size / np.maximum(size - 1, 1)
        variance = np.where(size == 1, self._variance, share)
        return np.asarray(np.sqrt(variance) * self.scale.points_per_log_odds)

    @property
    def prior_means(self) -> PriorMeans:
        """The means of the players' priors, and the evidence of earlier results, in log-odds."""
        return self._means or PriorMeans.none(len(self.players))

    @property
    def expected(self) -> Floats:
        """Each player's expected rating before any result, in points."""
        mean = self.prior_means.expected(self._level)
        return self.anchor + self.scale.points_per_log_odds * mean

    @property
    def newcomer_share(self) -> float:
        """The fraction of `levels.newcomers` by which a newcomer is below the average player."""
        games = (self.games + self.races_won + self.races_lost)[~self.idle]
        return float((1.0 - newness(games)).mean()) if len(games) else 0.0

    @property
    def newcomer(self) -> float:
        """How many points below the average experienced player a newcomer starts."""
        return self.scale.points(self.levels.newcomers) * self.newcomer_share

    @cached_property
    def groups(self) -> tuple[Group, ...]:
        """The level of each team and division that `levels` counts, relative to the average one.

        Teams and divisions are each sorted from strongest to weakest.
        """
        if not self.prior_means.names:
            return ()
        kinds = np.array([kind for kind, _ in self.prior_means.names])
        same = (kinds[:, None] == kinds).astype(float)
        contrast = np.eye(len(kinds)) - same / same.sum(1)
        covariance = contrast @ self._curvature.level_covariance @ contrast.T
        above = self.scale.points_per_log_odds * contrast @ self._level
        error = self.scale.points_per_log_odds * np.sqrt(np.diagonal(covariance))
        groups = [
            Group(kind, name, float(points), float(sd))
            for (kind, name), points, sd in zip(self.prior_means.names, above, error, strict=True)
        ]
        return tuple(sorted(groups, key=lambda group: (group.kind, -group.above, group.name)))

    @property
    def break_error(self) -> float | None:
        """The standard error of the break advantage in points, or None if it was not estimated."""
        variance = self._curvature.border_variance
        return None if variance is None else math.sqrt(variance) * self.scale.points_per_log_odds

    def difference_error(self, player: str, opponent: str) -> float:
        """Return the standard error of the difference between two ratings, in points.

        It takes their covariance into account, so it is smaller than the two standard errors
        suggest: uncertainty that both share, such as the level of the whole league, cancels.

        Raises
        ------
        InputError
            if a player is not rated, or no chain of opponents connects the two.

        Notes
        -----
        The variance is (e₁ - e₂)ᵀ H⁻¹ (e₁ - e₂): for up to 2,000 players, H is factorized once; for
        more, each pair is one linear system, solved by conjugate gradients.

        >>> from evenbreak.ratings import Results, fit
        >>> ratings = fit(Results.from_names(["Ann"], ["Bo"], [70], [50]), scale="fargo")
        >>> ratings.standard_error.round(1), round(ratings.difference_error("Ann", "Bo"), 1)
        (array([71.9, 71.9]), 26.2)
        """
        first, second = self._comparable(player, opponent)
        contrast = np.zeros(len(self.players))
        contrast[first] += 1.0
        contrast[second] -= 1.0
        variance = max(float(contrast @ self._curvature.times(contrast)), 0.0)
        return math.sqrt(variance) * self.scale.points_per_log_odds

    def difference_variances(self, first: Ints, second: Ints) -> Floats:
        """Return the variances of differences, in squared log-odds, by positions in `players`."""
        return np.maximum(self._curvature.difference_variances(first, second), 0.0)

    def covariance(self, players: Sequence[str]) -> Floats:
        """Return the covariance matrix of the given players' ratings, in squared points.

        Parameters
        ----------
        players
            names; the matrix has a row and a column for each, in this order.

        Raises
        ------
        InputError
            if a player is not rated.
        """
        contrasts = np.zeros((len(players), len(self.players)))
        for row, name in enumerate(players):
            contrasts[row, self._position(name)] = 1.0
        for members, level in self._levels():
            contrasts -= contrasts[:, members].sum(axis=1)[:, None] * level
        products = np.array([self._curvature.times(contrast) for contrast in contrasts])
        covariance = products.reshape(contrasts.shape) @ contrasts.T
        return (covariance + covariance.T) / 2.0 * self.scale.points_per_log_odds**2

    def win_probability(self, player: str, opponent: str) -> float:
        """Return P(`player` wins a game against `opponent` | both ratings are right).

        Raises
        ------
        InputError
            if a player is not rated, or no chain of opponents connects the two.
        """
        first, second = self._comparable(player, opponent)
        return self.scale.win_probability(float(self.rating[first] - self.rating[second]))

    @cached_property
    def _variance(self) -> Floats:
        """The variance of each rating in log-odds, regardless of anchors."""
        return self._curvature.variances()

    @cached_property
    def _curvature(self) -> Curvature:
        advantage = self.scale.log_odds(self.break_advantage or 0.0)
        return self._played.curvature(
            self._skill, advantage, self.prior_sd**-2, self._break_precision, self._means
        )

    def _levels(self) -> list[tuple[Bools, Floats]]:
        """Return the players of each anchored component, and their shares in its level."""
        at = np.array([self._position(name) for name, _ in self.named], dtype=np.int64)
        levels = []
        for number in np.unique(self.component[at]):
            own = at[self.component[at] == number]
            level = np.zeros(len(self.players))
            level[own] = 1.0 / len(own)
            levels.append((self.component == number, level))
        return levels

    def _comparable(self, player: str, opponent: str) -> tuple[int, int]:
        first, second = self._position(player), self._position(opponent)
        if self.component[first] != self.component[second]:
            raise InputError(
                "{a!r} and {b!r} aren't connected through opponents. Add results that connect "
                "them.",
                a=player,
                b=opponent,
            )
        return first, second

    @cached_property
    def _place(self) -> dict[str, int]:
        return {name: place for place, name in enumerate(self.players)}

    def _position(self, player: str) -> int:
        if player not in self._place:
            raise InputError("{name!r} isn't rated. Write the name as in the results.", name=player)
        return self._place[player]
