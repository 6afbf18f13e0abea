"""Match and handicap analytics for pool, from Markov chains.

A game is a directed graph; the graph is a transition matrix; the matrix has a
stochastic limit; every answer is read off that limit.

The public names load on first use, so that importing the package costs next to nothing.
"""

from evenbreak._lazy import attach

__version__ = "0.1.0"

__getattr__, __dir__, __all__ = attach(
    __name__,
    {
        "errors": [
            "AccuracyError",
            "ChainError",
            "DataError",
            "EvenbreakError",
            "GameError",
            "InputError",
            "WorkerError",
        ],
        "game": ["Game", "graph_of"],
        "games.rack": ["Rack"],
        "games.breaks": [
            "alternate_breaks",
            "loser_breaks",
            "player_1_breaks",
            "player_2_breaks",
            "winner_breaks",
        ],
        "games.race": ["Race"],
        "games.ahead": ["Ahead"],
        "games.one_ball": ["OneBall", "OneBallLookAhead"],
        "games.series": ["Series"],
        "games.drill": ["Drill"],
        "chains.explore": ["chain_of"],
        "chains.limits": ["absorption", "expected_visits", "limit_matrix", "stochastic_limit"],
        "chains.powers": ["propagate"],
        "chains.steps": ["first_passage", "steps_to_absorption"],
        "chains.spectrum": ["spectrum"],
        "chains.mixing": ["mixing_time", "spectral_gap"],
        "chains.rewards": ["long_run_reward", "total_reward"],
        "chains.sensitivity": ["sensitivity"],
        "chains.symbolic": ["symbolic_limit"],
        "stats.summary": ["Distribution"],
        "stats.binomial": ["GamesWon"],
        "stats.runs": ["RunLength"],
        "stats.innings": ["InningsScore"],
        "matches.win": ["race_win_probability", "win_probability"],
        "matches.length": ["match_length"],
        "matches.scores": ["final_scores"],
        "matches.scalar": ["match_odds"],
        "matches.live": ["live_odds"],
        "matches.formats": ["match_format"],
        "matches.crossings": ["crossings", "even_probability"],
        "matches.straight_pool": ["StraightPool", "straight_pool_odds"],
        "practice.drills": ["drill_statistics"],
        "practice.log_analysis": ["analyse_log"],
        "practice.shots": ["Shot", "compare_shots"],
        "practice.breaks": ["compare_break_formats"],
        "ratings.results": ["Results"],
        "ratings.fit": ["fit"],
        "ratings.prior": ["best_prior"],
        "ratings.roster": ["Roster"],
        "ratings.validate": ["validate"],
        "handicaps.fair": ["fair_races"],
        "handicaps.chart": ["Chart", "chart"],
        "handicaps.audit": ["audit"],
        "handicaps.design": ["design"],
        "handicaps.ladder": ["Ladder"],
    },
)
