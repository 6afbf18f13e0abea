"""The races that come nearest to the chance that a player should have.

All races up to a length are worth knowing at once: W(m, n), player 1's chance when he
needs m games and player 2 needs n, follows from W(m - 1, n) and W(m, n - 1), with who
breaks next where the break matters.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from evenbreak.checks import one_of, probability, whole
from evenbreak.errors import InputError
from evenbreak.games.breaks import BreakFormat
from evenbreak.games.rack import Rack
from evenbreak.matches.scalar import race_law

__all__ = ["FairRace", "fair_races"]

_TIE = 1e-9


@dataclass(frozen=True)
class FairRace:
    """One race and what it comes to.

    Parameters
    ----------
    race_1, race_2
        the games that player 1 and player 2 need.
    p_win_1
        P(player 1 wins the race).
    mean_games
        its mean length in games.
    games_p90
        the smallest number of games within which it ends with chance .9.
    """

    race_1: int
    race_2: int
    p_win_1: float
    mean_games: float
    games_p90: int


class _Candidate(NamedTuple):
    distance: float
    longest: int
    m: int
    n: int


def fair_races(
    rack: Rack | float,
    *,
    games: tuple[int, int] | None = None,
    race_to: int | None = None,
    target: float = 0.5,
    top: int = 5,
    breaks: BreakFormat | None = None,
    first_breaker: int = 1,
) -> list[FairRace]:
    """Return the races in which player 1's chance is nearest to `target`, the nearest first.

    Parameters
    ----------
    rack
        who wins a game: a `Rack`, or P(player 1 wins a game) where the break does not
        matter.
    games
        (lo, hi): the races m:n with lo <= m + n - 1 <= hi, the longest they can last.
    race_to
        instead: what the stronger player needs (player 1, if the two are equal); the
        weaker needs as many at most.
    target
        P(player 1 wins the race) that is aimed at.
    top
        how many races to return; fewer if there are no more.
    breaks
        who breaks next; needed with Rack(p1, p2).
    first_breaker
        who breaks the first game, 1 or 2.

    Returns
    -------
    list of FairRace
        by the distance from the target; of races within 1e-9 of each other's distance
        the shortest first (by the longest they can last), then the smaller `race_1`.

    Raises
    ------
    InputError
        if a parameter has a value that it cannot have, or not just one of `games` and
        `race_to` is given.

    Notes
    -----
    The chances: problem P5.5; with break formats P5.24.

    >>> for race in fair_races(2 / 3, games=(5, 7), top=2):
    ...     print(race.race_1, race.race_2, round(race.p_win_1, 3), round(race.mean_games, 2))
    4 2 0.461 4.02
    5 3 0.571 5.84
    >>> [(race.race_1, race.race_2) for race in fair_races(2 / 3, race_to=7, top=1)]
    [(7, 4)]
    """
    rack = rack if isinstance(rack, Rack) else Rack(rack)
    if not isinstance(rack.p1, float) or not isinstance(rack.p2, (float, type(None))):
        raise InputError("rack holds arrays; give one number for each chance")
    if rack.break_matters and breaks is None:
        raise InputError("breaks is missing: with p2 the break matters; give winner_breaks, ...")
    one_of(first_breaker, "first_breaker", (1, 2))
    target, top = probability(target, "target"), whole(top, "top", at_least=1)
    if (games is None) == (race_to is None):
        raise InputError(f"games is {games!r} and race_to is {race_to!r}; give just one of the two")
    wanted = _race_wanted(rack, whole(race_to, "race_to", at_least=1)) if games is None else None
    low, high = _span(games) if wanted is None else (1, 2 * max(wanted) - 1)
    candidates = sorted(
        _Candidate(abs(chance - target), m + n - 1, m, n)
        for m, n, chance in _win_table(rack, high, breaks, first_breaker)
        if m + n - 1 >= low and (wanted is None or _fits(m, n, wanted))
    )
    return [
        _describe(rack, m, n, breaks, first_breaker)
        for _, _, m, n in _shortest_of_ties(candidates)[:top]
    ]


def _race_wanted(rack: Rack, race_to: int) -> tuple[int, int]:
    """Return what player 1, 2 needs, 0 for the weaker player's open number."""
    # With p2 given, player 1 is the stronger if he holds his break more often.
    even = rack.chance(2) if rack.p2 is None else rack.p2
    return (race_to, 0) if rack.p1 >= even else (0, race_to)


def _fits(m: int, n: int, wanted: tuple[int, int]) -> bool:
    return n <= m == wanted[0] if wanted[0] else m <= n == wanted[1]


def _span(games: tuple[int, int] | None) -> tuple[int, int]:
    if games is None or len(games) != 2:
        raise InputError(f"games is {games!r}; give the pair (lo, hi)")
    low, high = (whole(limit, "games", at_least=1) for limit in games)
    if low > high:
        raise InputError(f"games is {games!r}; give the smaller number first")
    return low, high


def _win_table(
    rack: Rack, high: int, breaks: BreakFormat | None, first_breaker: int
) -> Iterator[tuple[int, int, float]]:
    """Yield m, n and P(player 1 wins the race m:n), for all m + n - 1 <= high."""
    if breaks is None or not rack.break_matters:
        breakers, first = [1], 0
        after = [(0, 0)]
    else:
        breakers, first = [1, 2], first_breaker - 1
        after = [(breaks(breaker, 1) - 1, breaks(breaker, 2) - 1) for breaker in breakers]
    won = [rack.chance(1, breaker) for breaker in breakers]
    lost = [rack.chance(2, breaker) for breaker in breakers]
    # rows[b][n]: player 1's chance of m:n when b breaks, for the m of the last round.
    rows = [[1.0] * (high + 1) for _ in breakers]
    for m in range(1, high + 1):
        fresh = [[0.0] for _ in breakers]
        for n in range(1, high - m + 2):
            values = [
                won[b] * rows[if_won][n] + lost[b] * fresh[if_lost][n - 1]
                for b, (if_won, if_lost) in enumerate(after)
            ]
            for row, value in zip(fresh, values, strict=True):
                row.append(value)
            yield m, n, values[first]
        rows = fresh


def _shortest_of_ties(candidates: list[_Candidate]) -> list[_Candidate]:
    """Return sorted candidates with those of practically one distance the shortest first."""
    ordered: list[_Candidate] = []
    tied: list[_Candidate] = []
    for candidate in candidates:
        if tied and candidate.distance > tied[0].distance + _TIE:
            ordered += sorted(tied, key=lambda one: one[1:])
            tied = []
        tied.append(candidate)
    return ordered + sorted(tied, key=lambda one: one[1:])


def _describe(
    rack: Rack, m: int, n: int, breaks: BreakFormat | None, first_breaker: int
) -> FairRace:
    law = race_law(m, n, rack.p1, rack.p2, breaks, first_breaker)
    return FairRace(m, n, law.p_win_1, law.mean, law.quantile(0.9))
