"""Chances averaged over the uncertainty in a skill difference.

According to the ratings, the difference d between two players is normal with mean m and variance v.
The prediction for a match is then not the chance at m but the average over all d of the chance of a
game, of the match, or of its whole score,

    P(score) = ∫ P(score | d) N(d; m, v) dd.

The last is the product of the chances of each game, given the days before and the earlier games of
the match. So it scores both who wins the games and how uncertain the difference is.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.special import expit, log_expit

from evenbreak.arrays import Floats, Ints, Places
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.results import Results
from evenbreak.ratings.who_broke import BreakWinsTerms, count_broken

NODES = 31
"""Nodes of the Gauss-Hermite rule that integrates over a difference of skill.

The chance of a score has a relative error of 1e-4 for variances up to 1 (in log-odds), which covers
all but the least known players, and 3e-3 for a variance of 2 in a long even match.
"""

_AT_ONCE = 500_000
"""Array elements allowed when several rating methods are evaluated together."""


@cache
def normal_nodes(many: int = NODES) -> tuple[Floats, Floats]:
    """Return the nodes and weights of a rule that averages over a standard normal.

    >>> points, weights = normal_nodes()
    >>> float(weights.sum().round(12)), float((weights @ points**2).round(12))
    (1.0, 1.0)
    """
    points, weights = np.polynomial.hermite_e.hermegauss(many)
    return points, weights / math.sqrt(2.0 * math.pi)


@dataclass(frozen=True, eq=False)
class Scores:
    """Match scores to predict: those with known games first, then those with only a winner.

    `broke` is 0 for unknown, 1 for a, -1 for b, or only the first if the break doesn't matter;
    `won` and `lost` have shape (len(broke), matches with games). `pattern` is each match's row in
    `own_breaks`, or -1, where only the score shows who broke (see `evenbreak.ratings.who_broke`).
    """

    player_a: Places
    player_b: Places
    broke: Floats
    won: Floats
    lost: Floats
    pattern: Ints
    own_breaks: BreakWinsTerms
    a_won: NDArray[np.bool_]
    race_a: Ints
    race_b: Ints

    @classmethod
    def of(cls, scored: Results, won_only: Results, *, breaks: bool) -> Scores:
        """Return the scores of matches with known games, and of those known only by their winner.

        `breaks` says whether it matters who broke.
        """
        won, lost = scored.score_a[None].astype(float), scored.score_b[None].astype(float)
        pattern, own_breaks = np.full(len(scored), -1), BreakWinsTerms.of([])
        if breaks:
            won, lost, pattern, own_breaks = count_broken(scored)
        players = ([each.player_a, each.player_b] for each in (scored, won_only))
        player_a, player_b = (np.concatenate(ends) for ends in zip(*players, strict=True))
        a_won = np.zeros(0, bool) if won_only.winner is None else won_only.winner == 1
        broke = np.array([0.0, 1.0, -1.0])[: len(won)]
        return cls(
            player_a, player_b, broke, won, lost, pattern, own_breaks, a_won, *won_only.races
        )

    @property
    def predicted(self) -> float:
        """The number of games, and of matches known only by their winner."""
        return float(self.won.sum() + self.lost.sum()) + len(self.a_won)

    def log_chances(self, mean: Floats, variance: Floats, advantage: Floats) -> Floats:
        """Return ln P(score | skill difference), in nats, for several rating methods.

        It is the probability of one order of the games, given their number. `mean` and `variance`
        describe a's skill minus b's, in natural log-odds, and have the shape (ways, matches), as
        the result does; the break advantage, taken as known, has shape (ways,).
        """
        several = max(1, _AT_ONCE // (NODES * max(mean.shape[1], 1)))
        parts = [slice(k, k + several) for k in range(0, len(mean), several)]
        ways = (mean, np.sqrt(variance), advantage)
        return np.concatenate([self._of_some(*(each[part] for each in ways)) for part in parts])

    def _of_some(self, mean: Floats, sd: Floats, advantage: Floats) -> Floats:
        points, weights = normal_nodes()
        d = mean[:, None] + points[:, None] * sd[:, None]
        scored = self.won.shape[1]
        games, races = d[..., :scored], d[..., scored:]
        log = np.zeros(games.shape)
        for side, won, lost in zip(self.broke, self.won, self.lost, strict=True):
            x = games + side * advantage[:, None, None]
            # ln P(b wins a game) is ln P(a wins it) - x.
            log += (won + lost) * log_expit(x) - lost * x
        top = log.max(1)
        score = top + np.log(np.einsum("k,wkm->wm", weights, np.exp(log - top[:, None])))
        if len(self.own_breaks.value):
            known = np.pad(self.own_breaks.log_sums(advantage)[0], ((0, 0), (0, 1)))
            score += known[:, self.pattern]
        if not len(self.a_won):
            return np.asarray(score)
        winner = np.where(self.a_won, races, -races)
        needs = np.where(self.a_won, (self.race_a, self.race_b), (self.race_b, self.race_a))
        p = np.einsum("k,wkm->wm", weights, race_win_probability(expit(winner), *needs))
        least = np.finfo(float).tiny
        return np.hstack([score, np.log(np.clip(p, least, 1.0))])
