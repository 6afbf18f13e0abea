"""The skills that matches show in several ways of rating, which share what they have in common.

They are those of `evenbreak.ratings.fit`. It goes through the matches for each way anew; here the
likelihood is made once for each half-life, what is known of players once for each set of levels,
and the search for the mode of one way begins at that of the way before.
"""

from __future__ import annotations

from typing import Any

from evenbreak.arrays import Floats
from evenbreak.ratings.fit import BREAK_SD, PRIOR_SD, checked_prior, known_advantage, weights_of
from evenbreak.ratings.levels import Levels, means_of
from evenbreak.ratings.likelihood_terms import LikelihoodTerms, likelihood_terms
from evenbreak.ratings.mixed_posterior import find_mixed_mode
from evenbreak.ratings.prior_means import PriorMeans
from evenbreak.ratings.results import Results
from evenbreak.ratings.scale import scale_of
from evenbreak.ratings.stated_strength import StatedStrength


class SeasonSoFar:
    """The matches before some day, to be rated in several ways.

    Parameters
    ----------
    results
        the matches; forfeits and those at 0-0 do not count.

    >>> from evenbreak.ratings import fit
    >>> season = Results.from_names(["Ann", "Bo", "Cy"], ["Bo", "Cy", "Ann"], [7, 7, 3], [4, 5, 7])
    >>> skill, _ = SeasonSoFar(season).skills(prior_sd=0.5)
    >>> skill.round(4), (fit(season, prior_sd=0.5).rating.round(2) - 80).round(2)
    (array([ 0.3007, -0.0457, -0.255 ]), array([ 13.01,  -1.98, -11.04]))
    """

    def __init__(self, results: Results) -> None:
        self._results = results
        self._scored, _, _ = results.played()
        self._won_only = results.won_only()
        self._terms: dict[tuple[float | None, bool], LikelihoodTerms] = {}
        self._means: dict[Levels, PriorMeans | None] = {}
        self._stated = StatedStrength(results)
        self._last: Floats | None = None

    def skills(
        self,
        *,
        prior_sd: float = PRIOR_SD,
        half_life: float | None = None,
        break_advantage: float | str | None = None,
        scale: Any = "npl",
        levels: Levels | None = None,
    ) -> tuple[Floats, float]:
        """Return the skills and the break advantage, both in natural log-odds.

        The parameters are those of `fit`.
        """
        breaks = break_advantage is not None
        known = known_advantage(break_advantage, scale_of(scale)) if breaks else 0.0
        terms = self._terms_of(half_life, breaks=breaks)
        estimated = known is None and bool(terms.games_with_breaker)
        mode = find_mixed_mode(
            terms,
            checked_prior(prior_sd) ** -2,
            advantage=known or 0.0,
            break_precision=BREAK_SD**-2 if estimated else None,
            means=self._means_of(levels or Levels(), half_life),
            start=self._last,
        )
        self._last = mode.point[: terms.players]
        return self._last, float(mode.point[-1]) if breaks and terms.games_with_breaker else 0.0

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
