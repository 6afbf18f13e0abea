"""Where players are expected to be before any result: the mean of the prior.

The skill of player i, in natural log-odds, is

    θi = mi + Zi b + ei,    ei ~ N(0, σ²),    bk ~ N(0, sk²),

with a known mean m, and levels b, one for each team or division, which are estimated with the
skills. A row of Z says which levels a player belongs to. Integrating b out would leave players of
one team correlated; kept as unknowns, levels are only further nodes of the graph of play.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.ratings.beginning import Known


@dataclass(frozen=True, eq=False)
class PriorMeans:
    """The mean of each player's prior, and the levels that players share.

    Attributes
    ----------
    mean
        the known part of each player's mean, in natural log-odds.
    design
        how much of each level a player has, shape (players, levels).
    level_sd
        standard deviation of each level's own prior, which is about 0.
    names
        what each level is called, such as ('team', 'Cue Tips').
    known
        what earlier results say of the skills; None: nothing.
    """

    mean: Floats
    design: Floats
    level_sd: Floats
    names: tuple[tuple[str, str], ...] = ()
    known: Known | None = None

    @classmethod
    def none(cls, players: int) -> PriorMeans:
        """Return the prior of a league about which nothing is known: all means 0."""
        return cls(np.zeros(players), np.zeros((players, 0)), np.zeros(0))

    @property
    def precision(self) -> Floats:
        """The prior precision of each level."""
        return np.asarray(self.level_sd**-2.0)

    def centred(self, among: Floats) -> PriorMeans:
        """Return the same prior, shifted so that all means are 0 on average over some players.

        Parameters
        ----------
        among
            the weight of each player in the average; all 0 leaves the prior as it is.

        >>> known = PriorMeans(np.array([0.0, 0.6]), np.array([[1.0], [0.0]]), np.array([0.5]))
        >>> known.centred(np.ones(2)).mean, known.centred(np.ones(2)).design.ravel()
        (array([-0.3,  0.3]), array([ 0.5, -0.5]))
        """
        total = float(among.sum())
        if total == 0.0:
            return self
        share = among / total
        return PriorMeans(
            self.mean - share @ self.mean,
            self.design - share @ self.design,
            self.level_sd,
            self.names,
            self.known,
        )

    def faded(self, keep: float) -> PriorMeans:
        """Return the same prior, with earlier results reduced to a part of their weight."""
        if self.known is None or keep == 1.0:
            return self
        return replace(self, known=Known(*(keep * one for one in self.known)))

    @property
    def information(self) -> Floats:
        """How much earlier results add to the precision of each skill."""
        return np.zeros(len(self.mean)) if self.known is None else self.known.information

    def expected(self, level: Floats) -> Floats:
        """Return each player's mean, given the levels."""
        return np.asarray(self.mean + self.design @ level)

    def log_density(self, skill: Floats, level: Floats, precision: float) -> float:
        """Return ln of the prior density of skills and levels, but for a constant.

        `precision` is 1/σ².
        """
        miss = skill - self.expected(level)
        prior = -0.5 * (precision * float(miss @ miss) + float(self.precision @ level**2))
        if self.known is None:
            return prior
        return prior + float((self.known.pull - 0.5 * self.known.information * skill) @ skill)

    def slopes(self, skill: Floats, level: Floats, precision: float) -> tuple[Floats, Floats]:
        """Return the gradient of minus the log density, in the skills and in the levels."""
        pull = precision * (skill - self.expected(level))
        of_level = self.precision * level - self.design.T @ pull
        if self.known is not None:
            pull = pull + self.known.information * skill - self.known.pull
        return pull, of_level
