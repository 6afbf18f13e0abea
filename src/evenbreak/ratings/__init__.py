"""From match results to ratings with uncertainty.

`scale` says what a rating difference means, `results` holds what was played, and
`fit` estimates Bradley-Terry ratings from it.
"""

from evenbreak._lazy import attach

__getattr__, __dir__, __all__ = attach(
    __name__,
    {
        "scale": ["SCALES", "Scale", "scale_of"],
        "results": ["Played", "Problem", "Results", "find_problems"],
        "fit": ["Ratings", "fit"],
    },
)
