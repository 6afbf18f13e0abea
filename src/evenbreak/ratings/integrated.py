"""Chances averaged over what is not known about a difference of skill.

Ratings say that the difference d of two players is normal, with the mean m and the variance v. What
they say about a match is then not the chance at m but the average over all d: of the chance of a
game, of the match, or of its whole score,

    P(score) = ∫ P(score | d) N(d; m, v) dd.

The last is the chance of each game given the days before and the games before it in the match,
multiplied. So it counts who wins the games as well as how far off the difference may be.
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

The chance of a score is right to 1e-4 of itself where the variance is up to 1 (in log-odds), as
that of all but the least known players is, and to 3e-3 for one of 2 and a long even match.
"""

_AT_ONCE = 500_000
"""Numbers in the arrays of several ways that are worked out together."""


@cache
def normal_nodes(many: int = NODES) -> tuple[Floats, Floats]:
    """Return the nodes of a rule that averages over a standard normal, and their weights.

    >>> points, weights = normal_nodes()
    >>> float(weights.sum().round(12)), float((weights @ points**2).round(12))
    (1.0, 1.0)
    """
    points, weights = np.polynomial.hermite_e.hermegauss(many)
    return points, weights / math.sqrt(2.0 * math.pi)


@dataclass(frozen=True, eq=False)
class Scores:
    """The scores of matches, to be predicted: those with known games first, then by winner alone.

    `broke` is 0 for unknown, 1 for a, -1 for b, only the first where it doesn't matter; `won` and
    `lost` have shape (len(broke), matches with games). `pattern` is each match's row in
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
        """Return the scores of matches with games in them, and of those known by their winner.

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
        """How many games there are, and matches known by their winner alone."""
        return float(self.won.sum() + self.lost.sum()) + len(self.a_won)

    def log_chances(self, mean: Floats, variance: Floats, advantage: Floats) -> Floats:
        """Return ln P(score | how the players differ), in nats, for several ways to rate.

        It is of the games in some order, given how many there were. `mean` and `variance` are of
        a's skill less b's, in natural log-odds, and the result, shape (ways, matches); the
        advantage of the break, taken as known, has shape (ways,).
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
