"""Leagues in the long run: whole seasons simulated, and what gaming a system pays.

`players` and `season` say what is played, `play` plays many replicas of it at once, `tally`
keeps what came of them.
"""

from evenbreak._lazy import attach

__getattr__, __dir__, __all__ = attach(
    __name__,
    {
        "one_season": ["PlayedSeason", "season_matches"],
        "play": ["chunk_replicas", "run_chunk"],
        "players": ["ESTABLISHED", "LeaguePlayers"],
        "schedule": ["FixedSchedule", "RandomPairing", "RoundRobin", "Schedule"],
        "season": ["Season"],
        "tally": ["Tally"],
    },
)
