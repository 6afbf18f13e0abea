"""The races that come nearest to the chance that a player should have.

All races up to a length are worth knowing at once: W(m, n), player 1's chance when he
needs m games and player 2 needs n, follows from W(m - 1, n) and W(m, n - 1), with who
breaks next where the break matters: all races that can last L games from those of L - 1.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from heapq import nsmallest
from typing import NamedTuple

from evenbreak.checks import one_of, probability, whole
from evenbreak.errors import InputError
from evenbreak.games.breaks import BreakFormat
from evenbreak.games.rack import Rack
from evenbreak.matches.races import next_breaks, race_odds

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


class _Fixed(NamedTuple):
    """What one of the two players needs, whatever the other does."""

    player: int
    games: int

    def m(self, longest: int) -> int:
        """Return what player 1 needs in the race that can last so long."""
        return self.games if self.player == 1 else longest + 1 - self.games


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
    if games is None:
        fixed = _Fixed(_stronger(rack), whole(race_to, "race_to", at_least=1))
        low, high = fixed.games, 2 * fixed.games - 1
    else:
        fixed = None
        low, high = _span(games)
    rows = _win_rows(rack, high, breaks, first_breaker)
    return [
        _describe(rack, m, n, breaks, first_breaker)
        for _, _, m, n in _nearest(rows, low, fixed, target, top)[:top]
    ]


def _stronger(rack: Rack) -> int:
    """Return the stronger player, 1 if they are equal."""
    # With p2 given, player 1 is the stronger if he holds his break more often.
    even = rack.chance(2) if rack.p2 is None else rack.p2
    return 1 if rack.p1 >= even else 2


def _span(games: tuple[int, int] | None) -> tuple[int, int]:
    if games is None or len(games) != 2:
        raise InputError(f"games is {games!r}; give the pair (lo, hi)")
    low, high = (whole(limit, "games", at_least=1) for limit in games)
    if low > high:
        raise InputError(f"games is {games!r}; give the smaller number first")
    return low, high


def _win_rows(
    rack: Rack, high: int, breaks: BreakFormat | None, first_breaker: int
) -> Iterator[list[float]]:
    """Yield P(player 1 wins m:n) for m = 1, 2, ... and m + n - 1 = 1; then for 2, ... to `high`."""
    steps = next_breaks(rack, breaks)
    first = first_breaker - 1 if rack.break_matters else 0
    # rows[b]: the chances when b breaks, from m = 0 (he has won) to n = 0 (he has lost).
    rows = [[1.0, 0.0] for _ in steps]
    for _ in range(high):
        rows = [
            [
                1.0,
                *(
                    won * one_less + lost * other_less
                    for one_less, other_less in zip(rows[if_won], rows[if_lost][1:], strict=False)
                ),
                0.0,
            ]
            for won, lost, if_won, if_lost in steps
        ]
        yield rows[first][1:-1]


def _nearest(
    rows: Iterable[list[float]], low: int, fixed: _Fixed | None, target: float, top: int
) -> list[_Candidate]:
    """Return the races nearest to the target in their order, `top` of them at least."""
    distances = [
        (longest, m, abs(row[m - 1] - target))
        for longest, row in enumerate(rows, start=1)
        if longest >= low
        for m in (range(1, longest + 1) if fixed is None else [fixed.m(longest)])
    ]
    furthest = nsmallest(top, (distance for _, _, distance in distances))[-1] + _TIE
    return _shortest_of_ties(
        sorted(
            _Candidate(distance, longest, m, longest + 1 - m)
            for longest, m, distance in distances
            if distance <= furthest
        )
    )


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
    law = race_odds(m, n, rack.p1, rack.p2, breaks, first_breaker)
    return FairRace(m, n, law.p_win_1, law.mean, law.quantile(0.9))
