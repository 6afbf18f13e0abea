"""Evenings played out match by match and rack by rack: slow, and apart from the library."""

import numpy as np


def played_evening(rng, races, pace, turnover, tables, pairs):
    """Return when an evening ends.

    `races` is (m, n, p) of each match; `pace` is (overhead, per game, sd of a match, sd of an
    evening) and `turnover` (median, mean), in minutes.
    """
    overhead, per_game, match_sd, evening_sd = pace
    median, mean = turnover
    waiting, free_at, table_free = list(range(len(races))), {}, [0.0] * tables
    ends = []
    while waiting:
        table = int(np.argmin(table_free))
        begins = [max(table_free[table], *(free_at.get(p, 0.0) for p in pairs[k])) for k in waiting]
        begin = min(begins)
        match = waiting.pop(begins.index(begin))
        minutes = played_match(rng, races[match], overhead, per_game)
        minutes *= rng.lognormal(-(match_sd**2) / 2, match_sd)
        ends.append(begin + minutes)
        pause = rng.lognormal(np.log(median), np.sqrt(2 * np.log(mean / median))) if mean else 0.0
        table_free[table] = begin + minutes + pause
        free_at |= dict.fromkeys(pairs[match], begin + minutes)
    return max(ends) * rng.lognormal(-(evening_sd**2) / 2, evening_sd)


def played_match(rng, race, overhead, per_game):
    m, n, p = race
    minutes = overhead
    while m and n:
        minutes += per_game
        if rng.random() < p:
            m -= 1
        else:
            n -= 1
    return minutes
