"""Handicaps: what makes an uneven game even, and what it does to ratings in the long run.

`fair` finds the races that come nearest to a chance that was asked for, `chart` looks races
up by rating difference, `level_chart` by skill levels, `ladder` says how far ratings wander
that each match moves by a point; a system of `systems` moves a list's ratings, `moves` by how
much after a night.
"""

from evenbreak._lazy import attach

__getattr__, __dir__, __all__ = attach(
    __name__,
    {
        "audit": ["AuditRow", "ChartAudit", "ChartFit", "audit", "even_doublings"],
        "chart": ["CHARTS", "Chart", "chart"],
        "chart_measure": ["ChartMeasure", "last_difference", "measure_chart"],
        "chart_rows": ["ChartDraft", "ChartRow"],
        "closed_league": ["ClosedPair", "in_step_law"],
        "design": ["design", "nearest_chart"],
        "error_walk": ["RatingLadder"],
        "fair": ["FairRace", "fair_races"],
        "fixed_length": ["fixed_length_chart"],
        "inflation": ["Lag", "NewcomerInflation", "inflation", "lag", "newcomer_inflation"],
        "ladder": ["Ladder"],
        "ladder_mixing": ["ladder_gap", "ladder_mixing"],
        "level_audit": ["LevelAudit", "LevelCell", "audit_levels"],
        "level_chart": ["LEVEL_CHARTS", "LevelChart", "level_chart"],
        "match_table": ["MatchTable", "match_table"],
        "moves": ["MatchMove", "Moves", "apply_results", "chart_of_night", "night_problems"],
        "opponents": ["AUTOCORRELATED", "EQUAL_SKILL", "NATURAL", "Opponents", "opponents_of"],
        "pareto": ["ParetoChart", "pareto"],
        "play": ["Play"],
        "race_limits": ["RaceLimits"],
        "settling": ["Settling", "settling"],
        "system_comparison": [
            "StepPoint",
            "SystemRow",
            "compare_systems",
            "mean_games",
            "step_front",
            "system_row",
        ],
        "systems": [
            "NEWCOMER_STEPS",
            "SYSTEMS",
            "PlayedMatch",
            "System",
            "elo_system",
            "fixed_length_system",
            "margin_system",
            "step_after",
            "step_system",
            "system_of",
        ],
        "uncertain": ["fairest_races", "length_given_ratings", "win_given_ratings"],
        "unfairness": ["better_off", "unfairness"],
    },
)
