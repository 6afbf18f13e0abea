"""The races closest to the chance that a player should have.

All races up to a given length are solved together. W(m, n), player 1's chance if player 1 needs m
games and player 2 needs n, follows from W(m - 1, n) and W(m, n - 1), and from who breaks next if
the break matters; so all races that can last L games follow from those of L - 1.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from heapq import nsmallest
from typing import Any, NamedTuple

from evenbreak.chains.ways import Way, way_of_limit
from evenbreak.checks import one_of, probability, whole
from evenbreak.errors import InputError
from evenbreak.games.breaks import BreakFormat
from evenbreak.games.rack import Rack
from evenbreak.matches.races import next_breaks, race_odds
from evenbreak.words import Parameter

_TIE = 1e-9


@dataclass(frozen=True)
class FairRace:
    """One race, with its chance and its length.

    Parameters
    ----------
    p_win_1
        P(player 1 wins the race).
    games_p90
        the smallest number of games within which it ends with chance .9.
    """

    race_1: int
    race_2: int
    p_win_1: float
    mean_games: float
    games_p90: int


class _Fixed(NamedTuple):
    """The games that one of the two players needs, for all races."""

    player: int
    games: int

    def m(self, longest: int) -> int:
        """Return what player 1 needs in the race that can last at most `longest` games."""
        return self.games if self.player == 1 else longest + 1 - self.games


class Candidate(NamedTuple):
    """A race m:n, its longest match, and the distance of its chance from the target."""

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
    via: Way | None = None,
) -> list[FairRace]:
    """Return the races in which player 1's chance is closest to `target`, closest first.

    Parameters
    ----------
    rack
        the chances in a game: a `Rack`, or P(player 1 wins a game) if the break does not matter.
    games
        (lo, hi): the races m:n whose longest match, m + n - 1 games, has lo to hi games.
    race_to
        instead of `games`: the games that the stronger player needs (player 1 if the two are
        equal); the weaker player needs at most as many.
    top
        the largest number of races to return.
    breaks
        needed with Rack(p1, p2).
    first_breaker
        1 or 2.
    via
        the method that calculates `p_win_1` of the returned races, as for `win_probability`; the
        default method chooses them.

    Returns
    -------
    list of FairRace
        sorted by distance from the target. If distances are equal to within 1e-9, the race with the
        shorter longest match comes first, then the one with the smaller `race_1`.

    Raises
    ------
    InputError
        if a parameter is out of range, or not exactly one of `games` and `race_to` is given.
    AccuracyError
        by eigenvectors, if the error may be above 1e-12.

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
        raise InputError("rack has arrays for its chances. Give one number for each chance.")
    if rack.break_matters and breaks is None:
        raise InputError(
            "breaks is missing: if p2 is given, the break matters. Give a break "
            "format, such as breaks=winner_breaks."
        )
    one_of(first_breaker, "first_breaker", (1, 2))
    target, top = probability(target, "target"), whole(top, "top", at_least=1)
    low, high = longest_matches(games, race_to)
    way = way_of_limit(via)
    fixed = None if race_to is None else _Fixed(_stronger(rack), low)
    rows = _win_rows(rack, high, breaks, first_breaker)
    races = [
        _describe(rack, m, n, breaks, first_breaker)
        for _, _, m, n in _nearest(rows, low, fixed, target, top)[:top]
    ]
    return (
        races
        if way is None
        else [_by_limit(race, rack, breaks, first_breaker, way) for race in races]
    )


def _by_limit(
    race: FairRace, rack: Rack, breaks: BreakFormat | None, first_breaker: int, via: Way
) -> FairRace:
    """Return the same race with its chance from the limit of its graph."""
    from evenbreak.games.race import Race
    from evenbreak.matches.by_limit import odds_by_limit

    played = Race(race.race_1, race.race_2, rack, breaks=breaks, first_breaker=first_breaker)
    return replace(race, p_win_1=odds_by_limit(played, via).p_win(1))


def _stronger(rack: Rack) -> int:
    """Return the number of the stronger player; 1 if they are equal."""
    # With p2 given, it is the one who wins more often on their own break.
    even = rack.chance(2) if rack.p2 is None else rack.p2
    return 1 if rack.p1 >= even else 2


def longest_matches(games: tuple[int, int] | None, race_to: int | None) -> tuple[int, int]:
    """Return the fewest and the most games in the longest match of the allowed races.

    Raises InputError unless exactly one of the two is given, in range.

    >>> longest_matches(None, 7), longest_matches((7, 13), None)
    ((7, 13), (7, 13))
    """
    if (games is None) == (race_to is None):
        raise InputError(
            "{games} is {value!r} and race_to is {race_to!r}. Give exactly one of them.",
            value=games,
            race_to=race_to,
        )
    if games is None:
        needs = whole(race_to, "race_to", at_least=1)
        return needs, 2 * needs - 1
    return games_range(games)


def _win_rows(
    rack: Rack, high: int, breaks: BreakFormat | None, first_breaker: int
) -> Iterator[list[float]]:
    """Yield P(player 1 wins m:n) for m = 1, 2, ...: first with m + n - 1 = 1, then 2, to `high`."""
    steps = next_breaks(rack, breaks)
    first = first_breaker - 1 if rack.break_matters else 0
    # rows[b]: player 1's chances when b breaks, from m = 0 (won already) to n = 0 (lost).
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
) -> list[Candidate]:
    """Return at least `top` of the races closest to the target, in order."""
    distances = [
        (longest, m, abs(row[m - 1] - target))
        for longest, row in enumerate(rows, start=1)
        if longest >= low
        for m in (range(1, longest + 1) if fixed is None else [fixed.m(longest)])
    ]
    furthest = nsmallest(top, (distance for _, _, distance in distances))[-1] + _TIE
    return shortest_of_ties(
        sorted(
            Candidate(distance, longest, m, longest + 1 - m)
            for longest, m, distance in distances
            if distance <= furthest
        )
    )


def shortest_of_ties(candidates: list[Candidate]) -> list[Candidate]:
    """Return sorted candidates, with the shortest first among practically equal distances."""
    ordered: list[Candidate] = []
    tied: list[Candidate] = []
    for candidate in candidates:
        if tied and candidate.distance > tied[0].distance + _TIE:
            ordered += sorted(tied, key=lambda race: race[1:])
            tied = []
        tied.append(candidate)
    return ordered + sorted(tied, key=lambda race: race[1:])


def _describe(
    rack: Rack, m: int, n: int, breaks: BreakFormat | None, first_breaker: int
) -> FairRace:
    law = race_odds(m, n, rack, breaks, first_breaker)
    return FairRace(m, n, law.p_win_1, law.mean, law.quantile(0.9))


# Which races a chart may hold.


def games_range(games: Any) -> tuple[int, int]:
    """Return the pair (lo, hi) if it holds two whole numbers in increasing order.

    >>> games_range((5, 7))
    (5, 7)
    """
    if not isinstance(games, tuple | list) or len(games) != 2:
        raise InputError("{games} must be a pair (lo, hi); you gave {value!r}", value=games)
    low, high = (whole(limit, "games", at_least=1) for limit in games)
    if low > high:
        raise InputError("{games} is {value!r}. Give the smaller number first.", value=games)
    return low, high


@dataclass(frozen=True)
class RaceLimits:
    """Limits on the races that a chart may hold.

    Parameters
    ----------
    games
        (lo, hi): the races m:n whose longest match, m + n - 1 games, has lo to
        hi games.
    stronger_least, weaker_least
        the fewest games that the stronger and the weaker player may need. The stronger
        player never needs fewer than the weaker.
    games_p90
        the number of games within which 9 out of 10 matches must end, at every difference; None: no
        such limit.

    Raises
    ------
    InputError
        if a limit is not a whole number from 1 up, `lo` is above `hi`, or no even race is
        left.

    >>> RaceLimits((5, 7), weaker_least=3).races
    ((3, 3), (4, 3), (4, 4), (5, 3))
    """

    games: tuple[int, int]
    stronger_least: int = 1
    weaker_least: int = 1
    games_p90: int | None = None

    def __post_init__(self) -> None:
        low, high = games_range(self.games)
        object.__setattr__(self, "games", (low, high))
        for name in ("stronger_least", "weaker_least"):
            object.__setattr__(self, name, whole(getattr(self, name), name, at_least=1))
        if self.games_p90 is not None:
            object.__setattr__(self, "games_p90", whole(self.games_p90, "games_p90", at_least=1))
        least = max(self.stronger_least, self.weaker_least)
        if max(least, (low + 2) // 2) > (high + 1) // 2:
            shortest = max(2 * least - 1, low + 1 - low % 2)
            raise InputError(
                "{games} is {low}..{high}, which leaves no even race to {least} or more. Make "
                "the second number {shortest} or more.",
                games=Parameter("games"),
                low=low,
                high=high,
                least=least,
                shortest=shortest,
            )

    @property
    def races(self) -> tuple[tuple[int, int], ...]:
        """The races (m, n), with m for the stronger player, from shortest to longest."""
        low, high = self.games
        return tuple(
            (m, longest + 1 - m)
            for longest in range(low, high + 1)
            for m in range(
                max(self.stronger_least, longest // 2 + 1), longest + 2 - self.weaker_least
            )
        )
