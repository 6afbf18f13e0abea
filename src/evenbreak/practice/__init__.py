"""Practice: what a drill log, a choice of shots or a break format tells a player.

This room joins games, chains and statistics; it reads no files.
"""

from evenbreak._lazy import attach

__getattr__, __dir__, __all__ = attach(
    __name__,
    {
        "breaks": [
            "BreakFormatValue",
            "compare_break_formats",
            "first_break_worth",
            "long_run_sd",
            "long_run_share",
        ],
        "drill_log": ["DrillLog"],
        "drills": ["DrillStatistics", "drill_statistics"],
        "log_analysis": ["LevelReport", "LogAnalysis", "analyse_log"],
        "log_tests": ["PlayedAgainTest"],
        "progressive_fit": ["ProgressiveFit", "fit_progressive"],
        "shots": [
            "RankedShot",
            "Shot",
            "break_even_p2",
            "compare_shots",
            "critical_p2",
            "look_ahead_win",
            "one_ball_win",
        ],
    },
)
