"""Results as likelihood terms, with different kinds of information and different weights.

Either a match's games are known, each won with the log-odds

    θi - θj + β,  θi - θj - β  or  θi - θj

depending on whether i broke, j broke, or the breaker is unknown; or only the winner of a race i:j
is known, which has the likelihood W(p(θi - θj); m, n). β is the break advantage. The logarithm of
every such term is concave in (θ, β). If it is known how many racks each player broke, but not who
won which, a term convex in β alone is added (see `evenbreak.ratings.who_broke`).

For such a race, with d the difference in natural log-odds, p = 1 / (1 + exp(-d)) and q = 1 - p, the
chance is W = I_p(m, n), the regularized incomplete beta function. Then

    d/dd log W = h,    d²/dd² log W = h (m q - n p - h),    h = p^m q^n / (B(m, n) W),

and the second is nowhere above zero: log W is concave, so matches known by their winners
alone have one most likely set of ratings. (The integrand of I_p, written in d, is
log-concave, and so is every integral of it from -∞: Prékopa 1973.)
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import sparse
from scipy.special import betainc, betaln, expit, hyp2f1, log_expit

from evenbreak.arrays import Floats, Ints, Places
from evenbreak.errors import InputError
from evenbreak.ratings.beginning import PriorMeans
from evenbreak.ratings.covariance import Curvature, Pattern, sums_by_player
from evenbreak.ratings.results import Results
from evenbreak.ratings.who_broke import BreakWinsTerms, count_broken


@dataclass(frozen=True, eq=False)
class LikelihoodTerms:
    """The results as terms of the log-likelihood.

    Terms of games have a pair (low, high), who broke (1 the low player, -1 the high one, 0 not
    known), and the games that the low player won and lost, weighted. Matches known only by their
    winner have the winner as `race_side` (1 or -1) and the games that winner and loser needed.
    `own_breaks` is the number of racks that players may have won on their own break, if only the
    score is known; the terms of games hold the middle value.
    """

    players: int
    low: Places
    high: Places
    pair: Places
    broke: NDArray[np.int8]
    won: Floats
    lost: Floats
    race_pair: Places
    race_side: Floats
    race_m: Floats
    race_n: Floats
    race_weight: Floats
    own_breaks: BreakWinsTerms
    own_break_weight: Floats

    @property
    def graph(self) -> sparse.csr_array:
        """Who met whom: shape (players, players), upper triangular."""
        ones = np.ones(len(self.low))
        shape = (self.players, self.players)
        return sparse.coo_array((ones, (self.low, self.high)), shape=shape).tocsr()

    @cached_property
    def _pattern(self) -> Pattern:
        return Pattern(self.players, self.low, self.high)

    @property
    def amount(self) -> float:
        """The weighted numbers of games and races."""
        return float(self.won.sum() + self.lost.sum() + self.race_weight.sum())

    @property
    def games_with_breaker(self) -> float:
        """The weighted number of games with a known breaker."""
        return float((self.won + self.lost)[self.broke != 0].sum())

    def log_likelihood(self, skill: Floats, advantage: float = 0.0) -> float:
        """Return ln P(results | the skills, the races, who broke, the number of games)."""
        difference = skill[self.low] - skill[self.high]
        x = difference[self.pair] + advantage * self.broke
        games = self.won @ np.logaddexp(0.0, -x) + self.lost @ np.logaddexp(0.0, x)
        races = race_slopes(
            self.race_side * difference[self.race_pair], self.race_m, self.race_n
        ).log_win
        own_breaks = self.own_breaks.log_sums(advantage)[0]
        return float(self.race_weight @ races + self.own_break_weight @ own_breaks - games)

    def derivatives(self, skill: Floats, advantage: float) -> tuple[Floats, float]:
        """Return the gradient of the negative log-likelihood in the skills and the advantage."""
        difference = skill[self.low] - skill[self.high]
        games = self.won + self.lost
        miss = games * expit(difference[self.pair] + advantage * self.broke) - self.won
        pull = np.bincount(self.pair, miss, len(self.low)).astype(np.float64)
        races = race_slopes(self.race_side * difference[self.race_pair], self.race_m, self.race_n)
        weight = self.race_weight * self.race_side * races.slope
        pull -= np.bincount(self.race_pair, weight, len(self.low))
        own_breaks = self.own_breaks.log_sums(advantage)[1]
        return self._net(pull), float(self.broke @ miss - self.own_break_weight @ own_breaks)

    def curvature(
        self,
        skill: Floats,
        advantage: float,
        precision: float,
        break_precision: float | None,
        means: PriorMeans | None = None,
    ) -> Curvature:
        """Return the Hessian of the negative log-posterior.

        If `break_precision` is None, the break advantage is not estimated; if `means` is None,
        players share no levels.
        """
        difference = skill[self.low] - skill[self.high]
        x = difference[self.pair] + advantage * self.broke
        bend = (self.won + self.lost) * expit(x) * expit(-x)
        weight = np.bincount(self.pair, bend, len(self.low)).astype(np.float64)
        races = race_slopes(self.race_side * difference[self.race_pair], self.race_m, self.race_n)
        weight -= np.bincount(self.race_pair, self.race_weight * races.curvature, len(self.low))
        border = corner = None
        if break_precision is not None:
            across = np.bincount(self.pair, self.broke * bend, len(self.low))
            border = self._net(across.astype(np.float64))
            spread = self.own_breaks.log_sums(advantage)[2]
            corner = float((self.broke != 0) @ bend - self.own_break_weight @ spread)
            corner += break_precision
        return Curvature(
            self.players,
            self.low,
            self.high,
            weight,
            precision,
            border,
            corner,
            means,
            self._pattern,
        )

    def _net(self, pull: Floats) -> Floats:
        """Return each player's sum over their pairs, with a negative sign where they are high."""
        return sums_by_player(self.players, self.low, self.high, pull, -pull)


def likelihood_terms(
    scored: Results, won_only: Results, weights: tuple[Floats, Floats], *, breaks: bool
) -> LikelihoodTerms:
    """Return results as likelihood terms: those with games, and those with only race and winner.

    `weights` are the weights of the matches in each; `breaks` is whether it matters who broke.
    """
    players = len(scored.players)
    pairs, place = np.unique(
        np.concatenate([_pair_codes(scored), _pair_codes(won_only)]), return_inverse=True
    )
    scored_place, race_place = place[: len(scored)], place[len(scored) :]
    won, lost = scored.score_a[None].astype(np.float64), scored.score_b[None].astype(np.float64)
    own_breaks, own_break_weight = BreakWinsTerms.of([]), np.zeros(0)
    if breaks:
        won, lost, pattern, own_breaks = count_broken(scored)
        with_breaker = pattern >= 0
        own_break_weight = np.bincount(
            pattern[with_breaker], weights[0][with_breaker], len(own_breaks.value)
        ).astype(np.float64)
    turned = scored.player_a > scored.player_b
    low_won, low_lost = np.where(turned, lost, won), np.where(turned, won, lost)
    sides = np.array([0, 1, -1])[: len(won), None] * np.where(turned, -1, 1)
    cell = 3 * scored_place + sides + 1
    kept = low_won + low_lost > 0
    terms, term = np.unique(cell[kept], return_inverse=True)
    weight = np.broadcast_to(weights[0], cell.shape)[kept]
    a_won = won_only.winner == 1 if won_only.winner is not None else np.zeros(0, bool)
    race_a, race_b = won_only.races
    a_is_low = won_only.player_a < won_only.player_b
    return LikelihoodTerms(
        players,
        (pairs // max(players, 1)).astype(np.intp),
        (pairs % max(players, 1)).astype(np.intp),
        (terms // 3).astype(np.intp),
        (terms % 3 - 1).astype(np.int8),
        np.bincount(term, low_won[kept] * weight, len(terms)).astype(np.float64),
        np.bincount(term, low_lost[kept] * weight, len(terms)).astype(np.float64),
        race_place.astype(np.intp),
        np.where(a_won == a_is_low, 1.0, -1.0),
        np.where(a_won, race_a, race_b).astype(np.float64),
        np.where(a_won, race_b, race_a).astype(np.float64),
        weights[1],
        own_breaks,
        own_break_weight,
    )


def _pair_codes(results: Results) -> Ints:
    low = np.minimum(results.player_a, results.player_b)
    high = np.maximum(results.player_a, results.player_b)
    return np.asarray(low * len(results.players) + high)


_FAR = 1e-200
"""Below this chance, the logarithm is computed without W, which would underflow."""


class RaceSlopes(NamedTuple):
    """log W(p(d); m, n) and its first and second derivatives in d, elementwise."""

    log_win: Floats
    slope: Floats
    curvature: Floats


def race_slopes(difference: ArrayLike, m: ArrayLike, n: ArrayLike) -> RaceSlopes:
    """Return the log of the chance of winning a race, with its derivatives.

    Parameters
    ----------
    difference
        the winner's skill minus the loser's, in natural log-odds of a game.
    m, n
        the games that the winner and the loser of the match needed, 1 or more. The three
        are broadcast together.

    Returns
    -------
    RaceSlopes
        given that the games are independent and the break does not matter; finite for
        any finite difference.

    Raises
    ------
    InputError
        if the difference is not finite, or m or n is below 1.

    Notes
    -----
    The race: problem P5.5. Where W underflows: W = p^m q^n / (m B(m, n)) F(m + n, 1;
    m + 1; p), DLMF 8.17.8.

    >>> level = race_slopes(0.0, 2, 1)  # W = p²
    >>> [round(float(part), 6) for part in level]
    [-1.386294, 1.0, -0.5]
    """
    d, m, n = (np.asarray(part, dtype=np.float64) for part in (difference, m, n))
    if not np.isfinite(d).all():
        raise InputError("difference must hold finite numbers; one value isn't")
    if not ((m >= 1).all() and (n >= 1).all()):
        raise InputError(
            "m or n is below 1 somewhere. Give the number of games each player needs, 1 or more."
        )
    d, m, n = np.broadcast_arrays(d, m, n)
    if not d.size:
        return RaceSlopes(d, d, d)
    p, q = expit(d), expit(-d)
    win = betainc(m, n, p)
    density = m * log_expit(d) + n * log_expit(-d) - betaln(m, n)
    far = win < _FAR
    with np.errstate(divide="ignore"):
        log_win = np.where(win < 0.5, np.log(win), np.log1p(-betainc(n, m, q)))
    if far.any():
        log_win = np.where(far, density + _log_tail(m, n, np.where(far, p, 0.0)), log_win)
    slope: Any = np.exp(density - log_win)
    # What is left of rounding must not bend the other way.
    curvature = np.minimum(slope * (m * q - n * p - slope), 0.0)
    return RaceSlopes(log_win, slope, curvature)


def _log_tail(m: Any, n: Any, p: Any) -> Any:
    """Return log W minus the log of the density, for a p far below m / (m + n)."""
    return np.log(hyp2f1(m + n, 1.0, m + 1.0, p) / m)
