"""From match results to ratings with uncertainty.

`scale` says what a rating difference means, `results` holds what was played,
`consistency` says whether it can be true, and `fit` estimates Bradley-Terry ratings
from it.
"""

from evenbreak._lazy import attach

__getattr__, __dir__, __all__ = attach(
    __name__,
    {
        "scale": ["SCALES", "Scale", "scale_of"],
        "results": ["Played", "Results"],
        "roster": ["Roster"],
        "consistency": ["Problem", "find_problems"],
        "fit": ["Ratings", "fit"],
        "prior": ["PriorChoice", "best_prior"],
        "race_likelihood": ["RaceSlopes", "race_slopes"],
        "validate": ["Validation", "validate"],
        "walk_forward": ["Forecasts", "walk_forward"],
    },
)
