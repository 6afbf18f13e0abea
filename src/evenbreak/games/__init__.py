"""Games described as directed graphs: one family a file, each a small frozen dataclass.

Nothing here solves anything; `evenbreak.chains` and `evenbreak.matches` do.
"""

from evenbreak._lazy import attach

__getattr__, __dir__, __all__ = attach(
    __name__,
    {
        "rack": ["Rack"],
        "breaks": [
            "BREAK_FORMATS",
            "BreakFormat",
            "alternate_breaks",
            "loser_breaks",
            "player_1_breaks",
            "player_2_breaks",
            "winner_breaks",
        ],
        "match": ["Match"],
        "race": ["Race"],
        "ahead": ["Ahead"],
        "one_ball": ["OneBall", "OneBallLookAhead"],
        "series": ["Series"],
        "drill": ["Drill"],
        "catalogue": ["CATALOGUE"],
    },
)
