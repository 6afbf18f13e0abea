"""Exact answers for matches: who wins, how long it takes, with what score.

`win_probability`, `match_length` and `final_scores` take arrays of chances;
`evenbreak.matches.scalar` answers for plain numbers without numpy.
"""

from evenbreak._lazy import attach

__getattr__, __dir__, __all__ = attach(
    __name__,
    {
        "crossings": ["Crossing", "Crossings", "crossings", "even_probability"],
        "evening": ["Evening", "Length", "LengthLaw", "evening"],
        "formats": ["MatchFormat", "match_format"],
        "length": ["MatchLength", "match_length"],
        "live": ["LiveOdds", "Standing", "live_odds"],
        "scores": ["FinalScores", "final_scores", "hill_hill_probability"],
        "shutout": ["shutout_probability"],
        "straight_pool": [
            "EvenPoints",
            "StraightPool",
            "StraightPoolOdds",
            "even_points",
            "straight_pool_odds",
        ],
        "win": ["race_win_probability", "win_probability"],
        "scalar": ["Odds", "RaceLaw", "match_odds", "race_law"],
    },
)
