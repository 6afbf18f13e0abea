"""Schedules: everybody meets everybody, nobody twice in a round, lists as they stand."""

from __future__ import annotations

import pickle
import sys
from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.league.schedule import (
    FixedSchedule,
    RandomPairing,
    RoundRobin,
    Schedule,
    rounds_of,
)

RNG = np.random.default_rng(1)


def pairs_of(rounds: object) -> list[frozenset[int]]:
    return [frozenset(pair) for a, b in rounds for pair in zip(a.tolist(), b.tolist(), strict=True)]  # type: ignore[attr-defined]


@pytest.mark.parametrize("players", [2, 3, 4, 5, 8, 9, 24])
def test_round_robin_lets_everybody_meet_everybody_once_in_a_cycle(players: int) -> None:
    weeks = players - 1 + players % 2
    met = Counter(
        pair
        for week in range(1, weeks + 1)
        for pair in pairs_of(RoundRobin(players).pairs(week, RNG, players))
    )
    assert len(met) == players * (players - 1) // 2
    assert set(met.values()) == {1}
    again = RoundRobin(players).pairs(weeks + 1, RNG, players)
    assert pairs_of(again) == pairs_of(RoundRobin(players).pairs(1, RNG, players))


def test_round_robin_of_several_matches_a_week_goes_through_the_same_rounds() -> None:
    single = [pairs_of(RoundRobin(6).pairs(week, RNG, 6)) for week in (1, 2, 3, 4)]
    double = [RoundRobin(6, matches_a_week=2).pairs(week, RNG, 6) for week in (1, 2)]
    assert [pairs_of([one]) for rounds in double for one in rounds] == single


@pytest.mark.parametrize("count", [2, 7, 64, 1000, 1001])
def test_random_pairing_pairs_everybody_but_one(count: int) -> None:
    rounds = RandomPairing(3).pairs(1, np.random.default_rng(3), count)
    assert len(rounds) == 3
    for a, b in rounds:
        assert len(a) == len(b) == count // 2
        assert len({*a.tolist(), *b.tolist()}) == 2 * (count // 2)


@pytest.mark.parametrize(("few", "count"), [(1000, 4), (0, 4), (0, 3)])
def test_random_pairing_draws_every_pair_alike(few: int, count: int, monkeypatch) -> None:
    monkeypatch.setattr(sys.modules[RandomPairing.__module__], "_FEW", few)
    rng = np.random.default_rng(5)
    met = Counter(
        pair for _ in range(3_000) for pair in pairs_of(RandomPairing().pairs(1, rng, count))
    )
    assert len(met) == count * (count - 1) // 2
    # Each of the six pairs, or three, with chance 1/3 a week; 5 standard errors of 3,000 weeks.
    assert max(abs(times - 1_000) for times in met.values()) < 5 * (3_000 * 2 / 9) ** 0.5


def test_random_pairing_of_many_leagues_draws_each_by_itself() -> None:
    ((a, b),) = RandomPairing().many_pairs(np.random.default_rng(5), 5, 3_000)
    assert a.shape == b.shape == (3_000, 2)
    met = Counter(
        tuple(sorted(pair)) for pair in zip(a.ravel().tolist(), b.ravel().tolist(), strict=True)
    )
    assert len(met) == 10
    # Each of the ten pairs with chance 1/5.
    assert max(abs(times - 600) for times in met.values()) < 5 * (3_000 * 4 / 25) ** 0.5


@pytest.mark.slow
@given(
    st.lists(
        st.tuples(st.integers(0, 6), st.integers(0, 6)).filter(lambda pair: pair[0] != pair[1]),
        max_size=30,
    )
)
def test_rounds_keep_every_match_and_the_order_of_each_player(pairs: list[tuple[int, int]]) -> None:
    a, b = np.array(pairs, dtype=np.int64).reshape(-1, 2).T
    rounds = rounds_of(a, b)
    for one, other in rounds:
        assert len({*one.tolist(), *other.tolist()}) == 2 * len(one)
    played = [
        pair for one, other in rounds for pair in zip(one.tolist(), other.tolist(), strict=True)
    ]
    assert sorted(played) == sorted(pairs)
    for player in range(7):
        assert [pair for pair in played if player in pair] == [
            pair for pair in pairs if player in pair
        ]


def test_fixed_schedule_gives_each_week_its_matches() -> None:
    fixtures = FixedSchedule([2, 1, 2], [0, 1, 0], [1, 2, 2])
    assert pairs_of(fixtures.pairs(1, RNG, 3)) == [{1, 2}]
    assert pairs_of(fixtures.pairs(2, RNG, 3)) == [{0, 1}, {0, 2}]
    assert fixtures.pairs(9, RNG, 3) == []
    assert (fixtures.weeks, len(fixtures)) == (2, 3)
    assert (FixedSchedule([], [], []).weeks, FixedSchedule([], [], []).pairs(1, RNG, 2)) == (0, [])


@pytest.mark.parametrize("schedule", [RoundRobin(4), RandomPairing(), FixedSchedule([1], [0], [1])])
def test_schedules_travel_to_other_processes(schedule: Schedule) -> None:
    other = pickle.loads(pickle.dumps(schedule))  # noqa: S301
    same = [pairs_of(each.pairs(1, np.random.default_rng(7), 4)) for each in (schedule, other)]
    assert same[0] == same[1] != []


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: RoundRobin(1), "players must be a whole number, 2 or more; you gave 1"),
        (lambda: RandomPairing(0), "matches_a_week must be a whole number, 1 or more; you gave 0"),
        (
            lambda: FixedSchedule([0], [0], [1]),
            r"week must be whole numbers, 1 or more; it holds 0\.0",
        ),
        (lambda: FixedSchedule([1], [0.5], [1]), r"holds 0\.5"),
        (lambda: FixedSchedule(["x"], [0], [1]), "week must be whole numbers, 1 or more; it is"),
        (lambda: FixedSchedule([1, 1], [0], [1]), "week, a and b have 2, 1 and 1 values"),
        (lambda: FixedSchedule([1], [3], [3]), "match 0 has player 3 twice"),
        (
            lambda: FixedSchedule([1], [0], [9]).pairs(1, RNG, 3),
            "has matches for player 9, but the league",
        ),
        (lambda: RoundRobin(4).pairs(1, RNG, 5), "players is 4, but the league has 5"),
    ],
)
def test_refusals_say_how_to_mend(make: object, message: str) -> None:
    with pytest.raises(InputError, match=message):
        make()  # type: ignore[operator]
