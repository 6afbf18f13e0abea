"""Leagues in the long run: whole seasons simulated, and what gaming a system pays.

`players` and `season` say what is played, `play` plays many replicas of it at once, `tally`
keeps what came of them.
"""

from evenbreak._lazy import attach

__getattr__, __dir__, __all__ = attach(
    __name__,
    {
        "dump_cycle": ["DumpCycle", "best_cycle", "dump_cycle"],
        "nights": ["Night", "nights_of", "played_nights"],
        "on_dask": ["DaskExecutor"],
        "one_season": ["PlayedSeason", "season_matches"],
        "play": ["run_chunk"],
        "players": ["ESTABLISHED", "LeaguePlayers"],
        "reestimate": ["Reestimated", "reestimate"],
        "sandbag": ["DumpRow", "Sandbagging", "entering_low", "sandbagging"],
        "schedule": ["FixedSchedule", "RandomPairing", "RoundRobin", "Schedule"],
        "season": ["Season"],
        "simulate": ["simulate"],
        "tally": ["Tally"],
        "watch": ["Watched", "watch"],
        "watch_power": ["WatchPower", "watch_power"],
    },
)
