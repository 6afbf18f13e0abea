"""Scores that can hardly be games won, so they say nothing about the games within a match."""

from __future__ import annotations

import numpy as np

from evenbreak.arrays import Bools, Ints
from evenbreak.ratings.results import Results

FEWEST_MATCHES = 20
"""Matches needed to tell how long a file's matches are."""


HIGH = 25
"""Scores below this are never doubted: few races are longer."""


TIMES = 2.5
"""A score is doubted above this multiple of what 95% of the winners need."""


def doubtful_scores(results: Results) -> Bools:
    """Return which scores are so much higher than the others that they can hardly be games won.

    A score is compared with all others, except that a score with a stated race is never doubted.

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
    """Return the most that 95% of the winners need."""
    return float(np.quantile(score, 0.95, method="inverted_cdf"))
