"""Who plays whom, where and when: round robins, home and away, dates, tables, what is left.

The rounds are those of the canonical factorization with its home and away pattern (de Werra 1981,
"Scheduling in sports"), which has the fewest possible breaks (two matches in a row at home or
away).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date, timedelta
from itertools import combinations

import numpy as np

from evenbreak.arrays import Ints
from evenbreak.checks import whole
from evenbreak.errors import InputError

MOST_MEETINGS = 10


def round_robin(sides: int, times: int = 1) -> Ints:
    """Return a schedule in which every pair meets: round (from 1), home, away.

    Each of the n sides plays as often at home as away, or once more or less; a single round robin
    has n - 2 breaks (none if n is odd, where each side has a bye), and a double one, whose second
    half mirrors the first, 3n - 6.

    Parameters
    ----------
    sides
        number of teams or players.
    times
        how often every pair meets; home and away alternate from one time to the next.

    >>> round_robin(4).tolist()
    [[1, 0, 3], [1, 1, 2], [2, 3, 1], [2, 2, 0], [3, 2, 3], [3, 0, 1]]
    """
    count = whole(sides, "sides", at_least=2)
    turning = count - 1 + count % 2
    rows: list[tuple[int, int, int]] = []
    for week in range(turning):
        pairs = [(week, turning) if week % 2 == 0 else (turning, week)]
        for k in range(1, (turning + 1) // 2):
            ahead, behind = (week + k) % turning, (week - k) % turning
            pairs.append((ahead, behind) if k % 2 else (behind, ahead))
        rows += [(week + 1, *pair) for pair in pairs if max(pair) < count]
    once = np.array(rows, dtype=np.int64)
    mirrored = once[:, [0, 2, 1]]
    every = []
    for time in range(whole(times, "times", at_least=1, at_most=MOST_MEETINGS)):
        half = (mirrored if time % 2 else once).copy()
        half[:, 0] += time * turning
        every.append(half)
    return np.concatenate(every)


def clashes(schedule: Ints, venues: Sequence[str], room: Mapping[str, int]) -> int:
    """Return how many of a schedule's matches don't fit at their venue, round by round.

    A side's venue is '' if it doesn't matter; `room` is how many matches fit there in a round,
    unlimited if not given.
    """
    at = Counter((week, venues[home]) for week, home, _ in schedule.tolist())
    return sum(max(0, many - room.get(venue, many)) for (_, venue), many in at.items() if venue)


def seated(schedule: Ints, venues: Sequence[str], room: Mapping[str, int]) -> Ints:
    """Return a schedule in which sides that share a full venue are at home in turn.

    In pairs, they get numbers that are never at home in the same round; then sides are swapped as
    long as that reduces clashes.
    """
    count = len(venues)
    number = list(range(count))
    if not clashes(schedule, venues, room):
        return schedule
    at_home = [{week for week, home, _ in schedule.tolist() if home == k} for k in range(count)]
    free = list(range(count))
    seats: dict[int, int] = {}
    for venue in dict.fromkeys(filter(None, venues)):
        sharing = [side for side in range(count) if venues[side] == venue]
        if len(sharing) <= room.get(venue, len(sharing)):
            continue
        for one, other in zip(sharing[::2], sharing[1::2], strict=False):
            apart = (p for p in combinations(free, 2) if not at_home[p[0]] & at_home[p[1]])
            pair = next(apart, None)
            if pair is not None:
                seats[one], seats[other] = pair
                free = [k for k in free if k not in pair]
    rest = iter(free)
    number = [seats[side] if side in seats else next(rest) for side in range(count)]
    return _improved(schedule, number, venues, room)


def _improved(
    schedule: Ints, number: list[int], venues: Sequence[str], room: Mapping[str, int]
) -> Ints:
    """Return the schedule with these numbers, after swapping sides while that reduces clashes."""

    def drawn(number: Sequence[int]) -> Ints:
        side = np.argsort(number)
        return np.column_stack([schedule[:, 0], side[schedule[:, 1]], side[schedule[:, 2]]])

    best = clashes(drawn(number), venues, room)
    better = best > 0
    while better:
        better = False
        for one, other in combinations(range(len(number)), 2):
            if venues[one] == venues[other]:
                continue
            swapped = list(number)
            swapped[one], swapped[other] = number[other], number[one]
            left = clashes(drawn(swapped), venues, room)
            if left < best:
                number, best, better = swapped, left, left > 0
    return drawn(number)


def nights(
    count: int,
    begins: date,
    *,
    weekdays: Sequence[int] = (),
    skipped: Iterable[date] = (),
    ends: date | None = None,
) -> list[date]:
    """Return the dates of the given number of nights.

    Parameters
    ----------
    begins
        the earliest possible date.
    weekdays
        the days of the week (0 is Monday); if empty, the first day's weekday.
    skipped
        days to skip, such as holidays.
    ends
        the latest possible date.

    Raises
    ------
    InputError
        if there are too few days.

    >>> [str(day) for day in nights(3, date(2026, 12, 15), skipped=[date(2026, 12, 22)])]
    ['2026-12-15', '2026-12-29', '2027-01-05']
    """
    wanted = set(weekdays) or {begins.weekday()}
    free = set(skipped)
    found: list[date] = []
    day = begins
    last = ends or begins + timedelta(days=7 * (count + len(free) + 1))
    while len(found) < count and day <= last:
        if day.weekday() in wanted and day not in free:
            found.append(day)
        day += timedelta(days=1)
    if len(found) < count:
        raise InputError(
            "{count} nights are needed, but there are only {n} until {ends}. Start earlier, end "
            "later, or play more rounds a night.",
            count=count,
            n=len(found),
            ends=str(last),
        )
    return found


@dataclass(frozen=True)
class Fixture:
    """An upcoming match.

    Parameters
    ----------
    round
        from 1.
    date
        None if no dates are set.
    venue
        '' if unknown.
    table
        the (first) table; 0 if tables are not assigned.
    turn
        1 if it starts when the night does, 2 if it follows those matches, and so on.
    """

    round: int
    home: str
    away: str
    date: date | None = None
    venue: str = ""
    table: int = 0
    turn: int = 1


def fixtures(
    names: Sequence[str],
    *,
    times: int = 1,
    dates: Sequence[date] = (),
    rounds_a_night: int = 1,
    venues: Sequence[str] = (),
    tables: Mapping[str, int] | None = None,
    tables_a_match: int = 1,
) -> list[Fixture]:
    """Return the fixtures of a round robin, by round.

    Parameters
    ----------
    names
        the teams or players, in order of their numbers.
    rounds_a_night
        how many rounds are played in a night.
    venues
        each side's home venue, '' if unknown; all '' by default.
    tables
        the number of tables at each venue: each match is assigned one (or `tables_a_match`) in
        turn, and sides that share a venue with too few tables are at home in turn.
    tables_a_match
        how many tables a match takes.

    >>> for match in fixtures(["Ann", "Bo", "Cy"], dates=[date(2026, 9, k) for k in (1, 8, 15)]):
    ...     print(match.date, match.home, match.away)
    2026-09-01 Bo Cy
    2026-09-08 Cy Ann
    2026-09-15 Ann Bo
    """
    at = list(venues) or [""] * len(names)
    room = {venue: many // tables_a_match for venue, many in (tables or {}).items()}
    for venue, fitting in room.items():
        if not fitting:
            raise InputError(
                "{venue} has fewer tables than a match takes ({tables_a_match})",
                venue=venue or "the venue",
                tables_a_match=tables_a_match,
            )
    schedule = seated(round_robin(len(names), times), at, room)
    listed = []
    for week, home, away in schedule.tolist():
        night = (week - 1) // rounds_a_night
        day = dates[night] if dates else None
        listed.append(Fixture(week, names[home], names[away], day, at[home]))
    return _with_tables(listed, room, rounds_a_night, tables_a_match)


def _with_tables(
    listed: Sequence[Fixture], room: Mapping[str, int], rounds_a_night: int, each: int
) -> list[Fixture]:
    """Return the fixtures with tables, which shift by one from round to round."""
    found = []
    turns: Counter[tuple[int, str]] = Counter()  # those of earlier rounds of the night
    for week in dict.fromkeys(one.round for one in listed):
        night, earlier = divmod(week - 1, rounds_a_night)
        played: Counter[str] = Counter()
        for one in (one for one in listed if one.round == week):
            if one.venue not in room:
                found.append(replace(one, turn=earlier + 1))
                continue
            turn, place = divmod(played[one.venue], room[one.venue])
            table = (place + week - 1) % room[one.venue] * each + 1
            before = max(turns[night, one.venue], earlier)
            found.append(replace(one, table=table, turn=before + turn + 1))
            played[one.venue] += 1
        for venue, many in played.items():
            turns[night, venue] = max(turns[night, venue], earlier) - (-many // room[venue])
    return found


def still_to_play(names: Sequence[str], times: int, played: Ints) -> Ints:
    """Return the matches in a round robin that have not been played yet: home, away.

    Parameters
    ----------
    times
        number of meetings of each pair.
    played
        the matches played: home, away. It does not matter who was at home.

    Raises
    ------
    InputError
        if a pair has met more often than `times`.

    >>> still_to_play(["Acers", "Bankers", "Caroms"], 1, np.array([[2, 1]])).tolist()
    [[2, 0], [0, 1]]
    """
    met = Counter(tuple(sorted(pair)) for pair in played[:, :2].tolist())
    for pair, many in met.items():
        if many > times:
            raise InputError(
                "{team} and {team_2} have met {many} times, more than the {times} in this round "
                "robin",
                team=names[pair[0]],
                team_2=names[pair[1]],
                many=many,
                times=times,
            )
    every = round_robin(len(names), times)[:, 1:]
    kept = left_of(
        [(int(a), int(b)) for a, b in every], [(int(a), int(b)) for a, b in played[:, :2]]
    )
    return every[kept].reshape(-1, 2)


def left_of(listed: Sequence[tuple[int, int]], played: Iterable[tuple[int, int]]) -> list[int]:
    """Return the positions of the fixtures that have not been played.

    Each match played is matched to its pair's first remaining fixture, with the same side at home
    if possible.

    >>> left_of([(0, 1), (1, 0), (0, 2)], [(1, 0)])
    [0, 2]
    """
    left = dict(enumerate(listed))
    for pair_played in played:
        for wanted in (pair_played, pair_played[::-1]):
            done = next((k for k, pair in left.items() if pair == wanted), None)
            if done is not None:
                del left[done]
                break
    return list(left)
