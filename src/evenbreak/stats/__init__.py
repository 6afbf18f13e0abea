"""Statistics of scores: what to expect of games won, runs and innings, and what scores tell.

This room knows numbers only: no game, no chain, no file.
"""

from evenbreak._lazy import attach

__getattr__, __dir__, __all__ = attach(
    __name__,
    {
        "binomial": [
            "GamesWon",
            "ScoreRange",
            "coverage_within",
            "critical_value",
            "score_probability",
        ],
        "compare": ["Comparison", "Effect", "Scores", "Significance", "compare"],
        "confidence": [
            "Luck",
            "MeanInterval",
            "Reading",
            "mean_interval",
            "sd_of_mean",
            "was_it_luck",
        ],
        "counts": ["CountLaw", "whole_counts"],
        "exact": ["exact"],
        "innings": ["InningsScore"],
        "runs": ["FairLine", "RunLength", "median_ratio_limit", "shot_chance"],
        "summary": ["Distribution", "Moments", "merge"],
        "trend": ["Trend", "trend"],
    },
)
