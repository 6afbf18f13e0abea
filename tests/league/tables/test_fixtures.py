"""Who plays whom: the laws of round robins, venues, dates, tables, and what is left."""

from collections import Counter
from datetime import date
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.league import fixtures, nights, round_robin, still_to_play
from evenbreak.league.tables.fixtures import clashes, left_of, seated
from rows import each_of
from tiers import examples


def breaks(schedule: np.ndarray, sides: int) -> int:
    """Return how often a side is at home, or away, twice in a row."""
    found = 0
    for side in range(sides):
        home = [row[1] == side for row in schedule.tolist() if side in row[1:]]
        found += sum(one == other for one, other in pairwise(home))
    return found


@each_of("sides, times", [(n, times) for n in range(2, 25) for times in (1, 2, 3)])
def test_a_round_robin_is_what_combinatorics_says(sides: int, times: int) -> None:
    schedule = round_robin(sides, times)
    rounds = sides - 1 + sides % 2
    met = Counter(frozenset(row[1:]) for row in schedule.tolist())
    assert set(met.values()) == {times}
    assert len(met) == sides * (sides - 1) // 2
    for week in range(1, rounds * times + 1):
        # Nobody is in a round twice, and of an odd number one has a bye.
        busy = schedule[schedule[:, 0] == week, 1:].ravel().tolist()
        assert len(set(busy)) == len(busy) == sides - sides % 2
    assert np.ptp(np.bincount(schedule[:, 1], minlength=sides)) <= 1
    if times == 1:
        assert breaks(schedule, sides) == (0 if sides % 2 else sides - 2)
    if times == 2:
        half = len(schedule) // 2
        assert (schedule[half:] == schedule[:half][:, [0, 2, 1]] + [rounds, 0, 0]).all()
        assert sides % 2 or breaks(schedule, sides) == 3 * sides - 6
        assert len({tuple(row[1:]) for row in schedule.tolist()}) == len(schedule)


@settings(max_examples=examples(30))
@given(st.integers(4, 14), st.data())
def test_two_sides_of_a_venue_are_at_home_in_turn(sides: int, data: st.DataObject) -> None:
    pairs = data.draw(st.integers(1, sides // 2))
    order = data.draw(st.permutations(range(sides)))
    venues = [f"V{k // 2}" if k < 2 * pairs else "" for k in order]
    room = {f"V{k}": 1 for k in range(pairs)}
    schedule = seated(round_robin(sides, 2), venues, room)
    assert clashes(schedule, venues, room) == 0
    assert {tuple(row) for row in schedule[:, 1:].tolist()} == {
        (a, b) for a in range(sides) for b in range(sides) if a != b
    }


def test_what_no_schedule_can_avoid_is_counted() -> None:
    venues, room = ["Corner"] * 4, {"Corner": 1}
    assert clashes(seated(round_robin(4), venues, room), venues, room) == 3
    three = ["Corner"] * 3 + [""] * 3  # five rounds, and seven or eight matches at home
    assert clashes(seated(round_robin(6), three, room), three, room) <= 3


def test_nights_leave_holidays_out_and_take_several_days_of_a_week() -> None:
    days = nights(4, date(2026, 12, 15), weekdays=(1, 3), skipped=[date(2026, 12, 24)])
    assert [f"{day:%a %d}" for day in days] == ["Tue 15", "Thu 17", "Tue 22", "Tue 29"]
    with pytest.raises(
        InputError, match="4 nights are needed, but there are only 2 until 2026-09-08"
    ):
        nights(4, date(2026, 9, 1), ends=date(2026, 9, 8))


@each_of("rounds_a_night, tables, each", [(1, 2, 1), (2, 2, 1), (2, 3, 1), (1, 4, 2), (3, 6, 2)])
def test_nobody_is_in_two_places_and_no_table_holds_two_matches(
    rounds_a_night: int, tables: int, each: int
) -> None:
    listed = fixtures(
        [f"P{k}" for k in range(7)],
        times=2,
        dates=nights(-(-14 // rounds_a_night), date(2026, 9, 1)),
        rounds_a_night=rounds_a_night,
        tables={"": tables},
        tables_a_match=each,
    )
    assert len(listed) == 42
    for one in ("home", "away"):
        assert len({(m.date, m.turn, getattr(m, one)) for m in listed}) == len(listed)
    assert len({(m.date, m.turn, m.table) for m in listed}) == len(listed)
    assert {m.table for m in listed} <= set(range(1, tables + 1, each))


@settings(max_examples=examples(40))
@given(st.integers(2, 8), st.integers(1, 3), st.data())
def test_what_is_left_and_what_is_played_are_the_whole(sides, times, data) -> None:
    every = round_robin(sides, times)[:, 1:]
    some = data.draw(st.lists(st.sampled_from(range(len(every))), unique=True))
    turned = [every[k].tolist()[:: data.draw(st.sampled_from([1, -1]))] for k in some]
    left = still_to_play([f"S{k}" for k in range(sides)], times, np.array(turned).reshape(-1, 2))
    both = [frozenset(row) for row in [*turned, *left.tolist()]]
    assert Counter(both) == Counter(frozenset(row) for row in every.tolist())


def test_a_match_played_is_the_first_fixture_with_the_same_side_at_home() -> None:
    assert left_of([(0, 1), (1, 0), (0, 1)], [(1, 0), (1, 0)]) == [2]
    with pytest.raises(InputError, match="have met 2 times"):
        still_to_play(["A", "B"], 1, np.array([[0, 1], [1, 0]]))
    with pytest.raises(InputError, match="fewer tables than a match takes"):
        fixtures(["A", "B"], tables={"Corner": 1}, tables_a_match=2)
