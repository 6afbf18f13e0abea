"""How long a season of so many players and replicas takes, and how much memory.

python benchmarks/league_size.py PLAYERS REPLICAS
"""

from __future__ import annotations

import resource
import sys
import time

import numpy as np

from evenbreak.league import LeaguePlayers, RandomPairing, Season, simulate


def main(players: int, replicas: int) -> None:
    skill = np.clip(np.random.default_rng(1).normal(75.0, 20.0, players), 20, 130).round()
    club = LeaguePlayers.of(skill + np.arange(players) % 2, skill=skill)
    season = Season(club, "npl", "npl_10", RandomPairing(), weeks=30)
    start = time.perf_counter()
    tally = simulate(season, replicas=replicas, seed=1)
    seconds = time.perf_counter() - start
    matches = int(tally.matches.sum()) // 2
    mib = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024  # in KiB, on Linux
    print(f"{matches:,} matches in {seconds:.1f} s, {mib:,.0f} MiB at most")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
