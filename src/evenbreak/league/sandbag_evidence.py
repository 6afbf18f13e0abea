"""The evidence that a player sandbags: a likelihood ratio that may be looked at after every match.

A sandbagger dumps a share s of their matches, and no one knows which: they play those d points
below a constant skill, or lose them on purpose with the score of an honest defeat. The evidence
averages over s, d and the skill. If L_t(x) is the chance of the t-th result at skill x, and w is a
distribution of the skill,

    e_t = mean over s, d of [sum over x of w(x) prod (1 - s) L_t(x) + s L_t(x - d)] / honest

where `honest` is one of two:

- any: the constant or steadily changing skill that explains the results best, max over honest
  skills of prod L_t(x_t). Whatever the player's skill, e_t is then at most a likelihood ratio
  against the truth;
- established: a constant skill that differs from the rating at the start by an error with the
  distribution of rating errors, sum over x of v(x) prod L_t(x): a likelihood ratio against such a
  player, on average over that error.

The mean of a likelihood ratio against the truth is 1 after any number of matches, so
P(e_t ever reaches 1 / alpha | honest) <= alpha (Ville 1939).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.errors import AccuracyError
from evenbreak.handicaps.ladders.form import difference_law
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.scale import SCALES, Scale
from evenbreak.stats.summary import Distribution

_HELD = ("drifting", "steady", "other")

SHARES = (0.1, 0.25, 0.5)
"""The shares of matches that a sandbagger may dump."""

SHARES_MARKED = (0.3, 0.6, 0.9)
"""The same shares, among the matches that are marked as possibly dumped."""

DEPTHS = (30, 60, 120)
"""How many points below their skill a sandbagger may play dumped matches."""

GAINS = (-0.25, 0.0, 0.25, 0.5)
"""Points per match by which an honest player's skill may keep changing."""

AHEAD = (0, 15, 30)
"""How far a sandbagger's skill may be above the rating at the start, in points."""

HONEST = ("any", "established")
"""Who counts as honest: players of any skill, or players whose ratings are as accurate as the
ladder's.
"""

WIDEST = 60
"""The largest rating error at the start, in points, of a sandbagger or an established player."""

FARTHEST = WIDEST + max(DEPTHS)
"""The same limit for an honest player of any skill: as far as a sandbagger sinks. Otherwise, a
hopeless beginner would look like someone who dumps most of their matches."""


class SandbagEvidence:
    """Evidence against several players at once, match by match.

    `prior` is the distribution of each player's skill at the start, shape (players, skills): skills
    are whole points from -WIDEST to WIDEST around the rating. `shares` of dumped matches are
    averaged over; `kinds` is the number of ways to dump.

    The arrays `drifting` (players, gains, skills from -FARTHEST to FARTHEST), `steady` (players,
    skills) and `other` (players, shares, kinds, skills) hold the likelihoods of honest players of
    any skill, of established players, and of sandbaggers. Each is scaled, with the logarithm of its
    scale kept separately, so that nothing leaves the range of a float.
    """

    def __init__(self, prior: Floats, shares: Sequence[float], kinds: int) -> None:
        players, skills = prior.shape
        self.shares = np.asarray(shares, dtype=float)[:, None, None]
        self.drifting = np.ones((players, len(GAINS), 2 * FARTHEST + 1))
        self.steady = prior.copy()
        ahead = np.mean([_ahead(prior, points) for points in AHEAD], axis=0)
        shape = (players, len(shares), kinds, skills)
        self.other = np.broadcast_to(ahead[:, None, None, :], shape) / (len(shares) * kinds)
        self._log = {name: np.zeros(players) for name in _HELD}

    def add(self, drifting: Floats, kinds: Floats, *, marked: bool = True) -> None:
        """Add a match for each player, which may have been dumped if `marked`.

        Chances of the result have shape (players, gains, 2 * FARTHEST + 1), and by way of dumping
        (players, kinds, skills). Raises AccuracyError if a result is all but impossible at every
        skill.
        """
        near = slice(FARTHEST - WIDEST, FARTHEST + WIDEST + 1)
        steady = drifting[:, GAINS.index(0.0), near]
        earnest = steady[:, None, None, :]
        self.drifting = self.drifting * drifting
        self.steady = self.steady * steady
        self.other = self.other * (
            (1.0 - self.shares) * earnest + self.shares * kinds[:, None] if marked else earnest
        )
        for name in _HELD:
            held = getattr(self, name)
            top = held.reshape(held.shape[0], -1).max(axis=1)
            if not top.all():
                raise AccuracyError(
                    "a result is next to impossible with these ratings. Check the ratings, and "
                    "whether they are on the system's scale."
                )
            setattr(self, name, held / top.reshape(-1, *[1] * (held.ndim - 1)))
            self._log[name] += np.log(top)

    def log_e(self, honest: str) -> Floats:
        """Return log e against one kind of honest players in `HONEST`, shape (players,)."""
        sandbagger = np.log(self.other.sum(axis=(1, 2, 3))) + self._log["other"]
        if honest == "any":
            return np.asarray(
                sandbagger - np.log(self.drifting.max(axis=(1, 2))) - self._log["drifting"]
            )
        return np.asarray(sandbagger - np.log(self.steady.sum(axis=1)) - self._log["steady"])


def _ahead(prior: Floats, points: int) -> Floats:
    """Return the prior shifted up; anything beyond the range is held at its end."""
    if not points:
        return prior
    moved = np.zeros_like(prior)
    moved[:, points:] = prior[:, :-points]
    moved[:, -1] += prior[:, -points:].sum(axis=1)
    return moved


# The chance of a match result, by how far the player's skill is above the opponent's rating.
#
# Opponents' skills differ from their ratings by independent errors with a known distribution, and
# every player's form varies from match to match by a normal deviation of known size.


_UNITS = SCALES["npl"]


def units(points: float, scale: Scale) -> int:
    """Convert points of a scale to the whole points used for skills in this module.

    These are the National Pool League's points, 30 of which double the odds of a game.

    >>> from evenbreak.ratings.scale import SCALES
    >>> units(72.0, SCALES["npl"]), units(610.0, SCALES["fargo"])
    (72, 183)
    """
    # Halves upwards, as `evenbreak matchups` rounds.
    return math.floor(points * _UNITS.points_per_doubling / scale.points_per_doubling + 0.5)


class Result(NamedTuple):
    """A match from the watched player's point of view.

    The opponent's rating is in whole points, 30 of which double the odds; games and race, the
    player's own first, are None if unknown.
    """

    opponent: int
    games: tuple[int, int] | None
    race: tuple[int, int] | None
    won: bool
    marked: bool = True


class Likelihood:
    """Chance of a result, by how far the player's skill is above the opponent's rating.

    `error` is the distribution of a player's rating minus skill, and `day_sd` the standard
    deviation of everyone's form, drawn for each match, both in points of the scale.
    """

    def __init__(self, scale: Scale, error: Distribution, day_sd: float = 0.0) -> None:
        self.scale = scale
        self.error, lowest = _law_in_units(error, scale)
        size = _UNITS.points_per_doubling / scale.points_per_doubling
        form = difference_law(day_sd * size)
        self.lowest, self.least = lowest, lowest - len(form) // 2
        self.weights = np.convolve(self.error, form)

    def of(
        self,
        games: tuple[int, int] | None,
        race: tuple[int, int] | None,
        *,
        won: bool,
        first: int,
        last: int,
    ) -> tuple[Floats, Floats]:
        """Return the chance of a result if it is honest, and if it is a feigned honest defeat.

        The arrays have shape (last - first + 1,); differences are skill minus the opponent's
        rating, in points. The number of ways in which a score can come about is left out, since it
        does not depend on the skills.
        """
        points = np.arange(first + self.least, last + self.least + self.weights.size)
        p, q = _UNITS.win_probability(points), _UNITS.win_probability(-points)
        beaten = np.ones_like(p) if race is None else race_win_probability(q, *race[::-1])
        chance = self._chance(p, q, games, race, won=won)
        # A defeat of unknown likelihood weighs no more than honest play, and one too unlikely for
        # a float weighs nothing, so e is never too large.
        feigned = np.zeros_like(p)
        if not won:
            np.divide(chance, beaten, out=feigned, where=beaten > 0.0)
        return self._mixed(chance), self._mixed(feigned)

    def _chance(
        self,
        p: Floats,
        q: Floats,
        games: tuple[int, int] | None,
        race: tuple[int, int] | None,
        *,
        won: bool,
    ) -> Floats:
        if games is not None:
            return np.asarray(p ** games[0] * q ** games[1])
        if race is None:
            return np.ones_like(p)
        return np.asarray(
            race_win_probability(p, *race) if won else race_win_probability(q, *race[::-1])
        )

    def _mixed(self, chance: Floats) -> Floats:
        """Return the mean over the opponent's error, for each difference."""
        return np.correlate(chance, self.weights, "valid")


def _law_in_units(error: Distribution, scale: Scale) -> tuple[Floats, int]:
    """Return a distribution in `units` points, and the lowest of these points."""
    values = np.array([units(float(value), scale) for value in error.values])
    chances = np.array([float(chance) for chance in error.probability])
    lowest = int(values.min())
    return np.asarray(np.bincount(values - lowest, weights=chances), dtype=float), lowest
