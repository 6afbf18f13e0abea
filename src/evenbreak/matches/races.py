"""Odds of a race in plain numbers, without numpy.

After k racks the score is i : k - i, so the probabilities of the scores are a list over i. The next
rack moves probability from i to i + 1 or leaves it at i; probability that leaves the list has won
the race.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from evenbreak.checks import one_of, whole
from evenbreak.errors import InputError
from evenbreak.games.breaks import BreakFormat, checked_format
from evenbreak.games.rack import Rack
from evenbreak.matches.quantiles import quantile_of


class RaceOdds(NamedTuple):
    """Who wins a race, and after how many racks.

    Parameters
    ----------
    games
        the possible lengths in racks, from the start score on, ascending.
    win_1, win_2
        P(player 1, 2 wins after exactly games[k] racks), in the order of `games`.
    p_hill_hill
        P(the last possible rack decides).
    p_shutout_1, p_shutout_2
        P(player 1, 2 wins and the other wins no rack from the start score on).
    """

    games: Sequence[int]
    win_1: Sequence[float]
    win_2: Sequence[float]
    p_hill_hill: float
    p_shutout_1: float
    p_shutout_2: float

    @property
    def p_win_1(self) -> float:
        """P(player 1 wins the race)."""
        return _total(self.win_1)

    @property
    def p_win_2(self) -> float:
        """P(player 2 wins the race), a separate sum, so that it is accurate even if tiny."""
        return _total(self.win_2)

    @property
    def probability(self) -> list[float]:
        """P(the race takes games[k] racks), in the order of `games`."""
        return [by_1 + by_2 for by_1, by_2 in zip(self.win_1, self.win_2, strict=True)]

    @property
    def mean(self) -> float:
        """The mean length in racks."""
        return math.fsum(k * chance for k, chance in zip(self.games, self.probability, strict=True))

    @property
    def sd(self) -> float:
        """The standard deviation of the length in racks."""
        mean = self.mean
        return math.sqrt(
            math.fsum(
                (k - mean) ** 2 * chance
                for k, chance in zip(self.games, self.probability, strict=True)
            )
        )

    def quantile(self, q: float) -> int:
        """Return the smallest k with P(length <= k) >= q; ties within rounding count."""
        return self.games[quantile_of(self.probability, q)]


def race_odds(
    m: int,
    n: int,
    rack: Rack[float] | float,
    breaks: BreakFormat | None = None,
    first_breaker: int = 1,
    score: tuple[int, int] = (0, 0),
) -> RaceOdds:
    """Return who wins the race m:n, and after how many racks, from the start score on.

    Parameters
    ----------
    m, n
        the games that player 1 and player 2 need.
    rack
        one rack, or P(player 1 wins a rack) if the break does not matter.
    breaks
        who breaks next; needed with Rack(p1, p2).
    first_breaker
        who breaks the first rack, 1 or 2.
    score
        the games that each player has at the start. A player who has all the games they need has
        won.

    Raises
    ------
    InputError
        if a parameter has an invalid value; it says which.

    Notes
    -----
    Source: problems P5.5 and P5.6 (the race), P5.24 (break formats).

    >>> race = race_odds(3, 2, 2 / 3)
    >>> round(race.p_win_1, 12), race.games
    (0.592592592593, [2, 3, 4])
    """
    rack = (rack if isinstance(rack, Rack) else Rack(rack)).of_numbers()
    first_breaker = one_of(first_breaker, "first_breaker", (1, 2))
    need_1 = whole(m, "m") - whole(score[0], "score of player 1")
    need_2 = whole(n, "n") - whole(score[1], "score of player 2")
    if rack.break_matters and breaks is None:
        raise InputError(
            "breaks is missing: if p2 is given, the break matters. Give a break "
            "format, such as breaks=winner_breaks."
        )
    if need_1 <= 0 or need_2 <= 0:
        return _already_won(need_1, need_2)
    steps = next_breaks(rack, breaks)
    at = [[0.0] * (need_1 + 1) for _ in steps]
    at[first_breaker - 1 if rack.break_matters else 0][0] = 1.0
    win_1, win_2 = [0.0], [0.0]
    for k in range(need_1 + need_2 - 1):
        after = [[0.0] * (need_1 + 1) for _ in steps]
        alive = range(max(0, k - need_2 + 1), min(k, need_1 - 1) + 1)
        for row, (won, lost, next_won, next_lost) in zip(at, steps, strict=True):
            up, down = after[next_won], after[next_lost]
            for i in alive:
                mass = row[i]
                up[i + 1] += mass * won
                down[i] += mass * lost
        win_1.append(sum(row[need_1] for row in after))
        lost_at = k + 1 - need_2
        win_2.append(sum(row[lost_at] for row in after) if lost_at >= 0 else 0.0)
        at = after
    shortest = min(need_1, need_2)
    return RaceOdds(
        games=list(range(shortest, need_1 + need_2)),
        win_1=win_1[shortest:],
        win_2=win_2[shortest:],
        p_hill_hill=win_1[-1] + win_2[-1],
        p_shutout_1=win_1[need_1],
        p_shutout_2=win_2[need_2],
    )


def _total(chances: Sequence[float]) -> float:
    """Return the sum of the probabilities of disjoint events, capped at 1 against rounding."""
    return min(1.0, math.fsum(chances))


def next_breaks(rack: Rack, breaks: BreakFormat | None) -> list[tuple[float, float, int, int]]:
    """Return (P(1 wins), P(2 wins), next breaker if 1 wins, if 2 wins) for each breaker.

    The next breaker is a position in this list. If the break does not matter, one entry stands
    for both breakers.
    """
    if breaks is None or not rack.break_matters:
        return [(rack.chance(1), rack.chance(2), 0, 0)]
    breaks = checked_format(breaks)
    return [
        (
            rack.chance(1, breaker),
            rack.chance(2, breaker),
            breaks(breaker, 1) - 1,
            breaks(breaker, 2) - 1,
        )
        for breaker in (1, 2)
    ]


def _already_won(need_1: int, need_2: int) -> RaceOdds:
    if need_1 <= 0 and need_2 <= 0:
        raise InputError(
            "at this score, both players have won. Give a score at which at most one has."
        )
    won_1 = float(need_1 <= 0)
    return RaceOdds([0], [won_1], [1.0 - won_1], 0.0, won_1, 1.0 - won_1)
