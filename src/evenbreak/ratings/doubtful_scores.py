"""Scores that can hardly be games won: they say nothing about how games within a match go."""

from __future__ import annotations

import numpy as np

from evenbreak.arrays import Bools, Ints
from evenbreak.ratings.results import Results

FEWEST_MATCHES = 20
"""Matches from which a file shows how long its matches are."""


HIGH = 25
"""A score below this is never doubted: few races are longer."""


TIMES = 2.5
"""How many times what 95% of the winners need a score must be to be doubted."""


def doubtful_scores(results: Results) -> Bools:
    """Return which scores are so much higher than the others that they can hardly be games won.

    A score is compared with all others, but where its race is stated, it is not doubted.

    >>> from evenbreak.ratings import Results
    >>> season = Results.from_names(["Ann"] * 30, ["Bo"] * 30, [7] * 29 + [67], [5] * 29 + [45])
    >>> np.flatnonzero(doubtful_scores(season))
    array([29])
    """
    score = np.maximum(results.score_a, results.score_b)
    played = (score > 0) & ~results.given_away
    if played.sum() < FEWEST_MATCHES:
        return np.zeros(len(results), dtype=bool)
    judged = played & (results.races[0] == 0) & (score >= HIGH)
    return np.asarray(judged & (score > TIMES * usual_score(score[played])))


def usual_score(score: Ints) -> float:
    """Return what 95% of the winners need at most."""
    return float(np.quantile(score, 0.95, method="inverted_cdf"))
