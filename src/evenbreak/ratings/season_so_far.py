"""The skills that matches show in several ways of rating, which share what they have in common.

They are those of `evenbreak.ratings.fit`. It goes through the matches for each way anew; here the
likelihood is made once for each half-life, what is known of players once for each set of levels,
and the modes are found together, or each from the one before where there are many players.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.ratings.fit import BREAK_SD, PRIOR_SD, checked_prior, known_advantage, weights_of
from evenbreak.ratings.levels import Levels, means_of
from evenbreak.ratings.likelihood_terms import LikelihoodTerms, likelihood_terms
from evenbreak.ratings.many_modes import GRADIENT, WayToRate, find_modes
from evenbreak.ratings.mixed_posterior import find_mixed_mode
from evenbreak.ratings.prior_means import PriorMeans
from evenbreak.ratings.results import Results
from evenbreak.ratings.scale import scale_of
from evenbreak.ratings.stated_strength import StatedStrength
from evenbreak.ratings.unstated_scale import DEFAULT_SCALE

SOLVED_AT_ONCE = 80
"""Players up to which all ways are solved together, which is faster than one after the other."""


class SeasonSoFar:
    """The matches before some day, to be rated in several ways.

    Parameters
    ----------
    results
        the matches; forfeits and those at 0-0 do not count.

    >>> from evenbreak.ratings import fit
    >>> season = Results.from_names(["Ann", "Bo", "Cy"], ["Bo", "Cy", "Ann"], [7, 7, 3], [4, 5, 7])
    >>> (skill,), _ = SeasonSoFar(season).skills([{"prior_sd": 0.5}])
    >>> skill.round(4), (fit(season, prior_sd=0.5).rating.round(2) - 80).round(2)
    (array([ 0.3007, -0.0457, -0.255 ]), array([ 13.01,  -1.98, -11.04]))
    """

    def __init__(self, results: Results) -> None:
        self._results = results
        self._players = len(results.players)
        self._scored, _, _ = results.played()
        self._won_only = results.won_only()
        self._terms: dict[tuple[float | None, bool], LikelihoodTerms] = {}
        self._means: dict[Levels, PriorMeans | None] = {}
        self._stated = StatedStrength(results)
        self._last: Floats | None = None

    def skills(self, ways: Sequence[Mapping[str, Any]]) -> tuple[Floats, Floats]:
        """Return the skills in each way, and the break advantages, both in natural log-odds.

        The options of a way are those of `fit`: a prior, a half-life, a break advantage with its
        scale, and levels. All ways have a break advantage, or none.
        """
        asked = [self._asked(**way) for way in ways]
        if self._players <= SOLVED_AT_ONCE:
            skills, advantages = find_modes(asked, self._last)
            self._last = skills[-1]
            return skills, advantages
        points = np.array([self._mode(way) for way in asked])
        return points[:, :-1], points[:, -1]

    def _asked(
        self,
        *,
        prior_sd: float = PRIOR_SD,
        half_life: float | None = None,
        break_advantage: float | str | None = None,
        scale: Any = DEFAULT_SCALE,
        levels: Levels | None = None,
    ) -> WayToRate:
        breaks = break_advantage is not None
        known = known_advantage(break_advantage, scale_of(scale)) if breaks else 0.0
        terms = self._terms_of(half_life, breaks=breaks)
        # Without such games there is nothing to estimate.
        some = bool(terms.games_with_breaker)
        return WayToRate(
            terms,
            checked_prior(prior_sd) ** -2,
            (known or 0.0) * some,
            BREAK_SD**-2 if known is None and some else None,
            self._means_of(levels or Levels(), half_life),
        )

    def _mode(self, way: WayToRate) -> Floats:
        """Return the skills and the break advantage in one way."""
        mode = find_mixed_mode(
            way.terms,
            way.precision,
            advantage=way.advantage,
            break_precision=way.break_precision,
            means=way.means,
            start=self._last,
            gradient=GRADIENT,
        )
        self._last = mode.point[: self._players]
        return np.append(self._last, mode.point[-1])

    def _terms_of(self, half_life: float | None, *, breaks: bool) -> LikelihoodTerms:
        if (half_life, breaks) not in self._terms:
            weights = weights_of(self._scored, self._won_only, half_life, None)
            self._terms[half_life, breaks] = likelihood_terms(
                self._scored, self._won_only, weights, breaks=breaks
            )
        return self._terms[half_life, breaks]

    def _means_of(self, levels: Levels, half_life: float | None) -> PriorMeans | None:
        if levels not in self._means:
            self._means[levels] = means_of(self._results, levels, self._stated) if levels else None
        means = self._means[levels]
        if means is None or levels.beginning is None:
            return means
        return means.faded(levels.beginning.kept(half_life, self._results, None))
