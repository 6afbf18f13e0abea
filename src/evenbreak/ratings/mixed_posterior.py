"""The mode of the posterior where results differ in what they tell and how much they weigh.

Of a match either the games are known, each won with the log-odds

    θi - θj + β,  θi - θj - β  or  θi - θj

as i broke, j broke, or nobody knows who did; or only who won a race i:j, which has the
likelihood W(p(θi - θj); m, n). β is the break advantage. Every such term's logarithm is
concave in (θ, β), and the priors strictly so: there is one mode, and Newton's method with
a step that is halved until it goes down finds it. Where it is known how many racks each
broke, but not who won which of them, a term convex in β alone is added (see `splits`):
concave the sum still is in θ.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.special import expit

from evenbreak.errors import AccuracyError
from evenbreak.ratings.covariance import Curvature
from evenbreak.ratings.own_break_wins import Splits, stacked
from evenbreak.ratings.posterior import GRADIENT_TOLERANCE
from evenbreak.ratings.race_likelihood import race_slopes
from evenbreak.ratings.results import Results
from evenbreak.ratings.who_broke import count_broken

Floats = NDArray[np.float64]
Ints = NDArray[np.intp]

_MOST_STEPS = 200
_FULL_STEP = 1e-6
"""Newton steps shorter than this are taken whole: the value no longer tells their gain."""


@dataclass(frozen=True, eq=False)
class Evidence:
    """What was played, as terms of the log-likelihood.

    Attributes
    ----------
    players
        how many there are.
    low, high
        the two players of each pair that met.
    pair, broke, won, lost
        of each term of games: its pair, who broke (1 the low player, -1 the high one, 0
        nobody knows), and the games the low player won and lost, weighted.
    race_pair, race_side, race_m, race_n, race_weight
        of each match known by its winner alone: its pair, who won (1 the low player, -1
        the high one), the games that the winner and the loser needed, and its weight.
    splits, split_weight
        how games of which the score alone is known may have split between who broke, and
        what each such split weighs; the terms of games have the middle of each.
    """

    players: int
    low: Ints
    high: Ints
    pair: Ints
    broke: NDArray[np.int8]
    won: Floats
    lost: Floats
    race_pair: Ints
    race_side: Floats
    race_m: Floats
    race_n: Floats
    race_weight: Floats
    splits: Splits
    split_weight: Floats

    @property
    def graph(self) -> sparse.csr_array:
        """Who met whom: shape (players, players), upper triangular."""
        ones = np.ones(len(self.low))
        shape = (self.players, self.players)
        return sparse.coo_array((ones, (self.low, self.high)), shape=shape).tocsr()

    @property
    def amount(self) -> float:
        """How many games and races, weighted, there are."""
        return float(self.won.sum() + self.lost.sum() + self.race_weight.sum())

    @property
    def games_with_breaker(self) -> float:
        """How many games, weighted, there are of which it is known who broke."""
        return float((self.won + self.lost)[self.broke != 0].sum())

    def log_likelihood(self, skill: Floats, advantage: float = 0.0) -> float:
        """Return the natural logarithm of the chance of these results, given the skills.

        Given also the races, who broke where that is known, and of games their number.
        """
        difference = skill[self.low] - skill[self.high]
        x = difference[self.pair] + advantage * self.broke
        games = self.won @ np.logaddexp(0.0, -x) + self.lost @ np.logaddexp(0.0, x)
        races = race_slopes(
            self.race_side * difference[self.race_pair], self.race_m, self.race_n
        ).log_win
        split = self.splits.log_sums(advantage)[0]
        return float(self.race_weight @ races + self.split_weight @ split - games)

    def _ends(self, pull: Floats) -> Floats:
        """Return what pulls at each player: of his pairs, with the sign of his end."""
        total: Floats = np.bincount(self.low, pull, self.players).astype(np.float64)
        return total - np.bincount(self.high, pull, self.players)

    def derivatives(self, skill: Floats, advantage: float) -> tuple[Floats, float]:
        """Return the gradient of the negative log-likelihood in the skills and the advantage."""
        difference = skill[self.low] - skill[self.high]
        games = self.won + self.lost
        miss = games * expit(difference[self.pair] + advantage * self.broke) - self.won
        pull = np.bincount(self.pair, miss, len(self.low)).astype(np.float64)
        races = race_slopes(self.race_side * difference[self.race_pair], self.race_m, self.race_n)
        weight = self.race_weight * self.race_side * races.slope
        pull -= np.bincount(self.race_pair, weight, len(self.low))
        split = self.splits.log_sums(advantage)[1]
        return self._ends(pull), float(self.broke @ miss - self.split_weight @ split)

    def curvature(
        self, skill: Floats, advantage: float, precision: float, break_precision: float | None
    ) -> Curvature:
        """Return the Hessian of the negative log-posterior.

        `break_precision` None says that the break advantage is not estimated.
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
            border = self._ends(across.astype(np.float64))
            spread = self.splits.log_sums(advantage)[2]
            corner = float((self.broke != 0) @ bend - self.split_weight @ spread) + break_precision
        return Curvature(self.players, self.low, self.high, weight, precision, border, corner)


def evidence_of(
    scored: Results, won_only: Results, weights: tuple[Floats, Floats], *, breaks: bool
) -> Evidence:
    """Return the terms that results consist of.

    Parameters
    ----------
    scored, won_only
        matches with games in them, and matches of which only race and winner are known,
        of the same players.
    weights
        of the ones and of the others.
    breaks
        whether it matters who broke.
    """
    players = len(scored.players)
    pairs, place = np.unique(
        np.concatenate([_pair_codes(scored), _pair_codes(won_only)]), return_inverse=True
    )
    scored_place, race_place = place[: len(scored)], place[len(scored) :]
    won, lost = scored.score_a[None].astype(np.float64), scored.score_b[None].astype(np.float64)
    splits, split_weight = stacked([]), np.zeros(0)
    if breaks:
        won, lost, pattern, splits = count_broken(scored)
        known = pattern >= 0
        split_weight = np.bincount(pattern[known], weights[0][known], len(splits.value)).astype(
            np.float64
        )
    turned = scored.player_a > scored.player_b
    low_won, low_lost = np.where(turned, lost, won), np.where(turned, won, lost)
    sides = np.array([0, 1, -1])[: len(won), None] * np.where(turned, -1, 1)
    cell = 3 * scored_place + sides + 1
    terms, term = np.unique(cell[low_won + low_lost > 0], return_inverse=True)
    kept = low_won + low_lost > 0
    weight = np.broadcast_to(weights[0], cell.shape)[kept]
    a_won = won_only.winner == 1 if won_only.winner is not None else np.zeros(0, bool)
    race_a = np.zeros(0) if won_only.race_a is None else won_only.race_a
    race_b = np.zeros(0) if won_only.race_b is None else won_only.race_b
    a_is_low = won_only.player_a < won_only.player_b
    return Evidence(
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
        splits,
        split_weight,
    )


def _pair_codes(results: Results) -> NDArray[np.int64]:
    low = np.minimum(results.player_a, results.player_b)
    high = np.maximum(results.player_a, results.player_b)
    return np.asarray(low * len(results.players) + high)


class MixedMode(NamedTuple):
    """Where the posterior is highest, and how well it was found."""

    skill: Floats
    advantage: float
    gradient: float
    iterations: int


def find_mixed_mode(
    evidence: Evidence,
    precision: float,
    *,
    advantage: float = 0.0,
    break_precision: float | None = None,
    start: Floats | None = None,
) -> MixedMode:
    """Return the skills, and the break advantage, that are most likely a posteriori.

    Parameters
    ----------
    evidence
        what was played.
    precision
        τ, the prior precision of a skill, 1/sd² in log-odds.
    advantage
        the break advantage in log-odds: known, or where to begin.
    break_precision
        the prior precision of the advantage, about 0; None: it is known.
    start
        skills from which to begin.

    Raises
    ------
    AccuracyError
        if the gradient does not come down to rounding.
    """
    skill = np.zeros(evidence.players) if start is None else start

    def cost(skill: Floats, advantage: float) -> float:
        prior = 0.5 * precision * float(skill @ skill)
        prior += 0.5 * (break_precision or 0.0) * advantage**2
        return prior - evidence.log_likelihood(skill, advantage)

    most = max(float(evidence.race_m.max(initial=0)), evidence.amount)
    tolerance = max(GRADIENT_TOLERANCE * min(1.0, precision), 1e-14 * most)
    value = cost(skill, advantage)
    for iteration in range(_MOST_STEPS):
        gradient, slope = evidence.derivatives(skill, advantage)
        gradient = gradient + precision * skill
        slope = slope + break_precision * advantage if break_precision is not None else 0.0
        size = max(float(np.abs(gradient).max(initial=0.0)), abs(slope))
        if size <= tolerance:
            return MixedMode(skill, advantage, size, iteration)
        curvature = evidence.curvature(skill, advantage, precision, break_precision)
        step, shift = curvature.newton_step(gradient, slope, max(min(0.1, size), 1e-9))
        length, longest = 1.0, max(float(np.abs(step).max(initial=0.0)), abs(shift))
        while True:
            new = cost(skill + length * step, advantage + length * shift)
            if new <= value or longest * length < _FULL_STEP:
                break
            length *= 0.5
        skill, advantage, value = skill + length * step, advantage + length * shift, new
    raise AccuracyError(
        f"the ratings' gradient is {size:.1e} after {_MOST_STEPS} Newton steps; give a smaller "
        "prior_sd"
    )
