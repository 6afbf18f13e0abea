"""The clock: paces, schedules beside an obvious one, evenings from any point."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import lognorm

from evenbreak.errors import InputError
from evenbreak.matches.pace import PACES, Pace, Turnover
from evenbreak.tournaments import (
    InPlay,
    Races,
    Timed,
    double_elimination,
    event_pace,
    finish,
    groups_then_knockout,
    learned_pace,
    minutes_later,
    pair_odds,
    round_robin,
    single_elimination,
)
from evenbreak.tournaments.clock.table_schedule import longest_paths, schedule, waiting
from tiers import examples

EXACT = Pace(10.0, 5.0, 0.0, 0.0)
AT_ONCE = Turnover(0.0, 0.0)


def laws_of(bracket, race=3):
    return pair_odds(bracket, [500.0] * len(bracket.players), race)


# Paces.


def test_paces_as_fitted() -> None:
    for discipline, usual in PACES.items():
        pace = event_pace(discipline)
        level, evening_sd = (0.895, 0.09) if discipline == "10-ball" else (0.97, 0.12)
        assert pace.mean_minutes(5) == pytest.approx(level * usual.mean_minutes(5))
        assert (pace.match_sd, pace.evening_sd) == (usual.match_sd, evening_sd)
    assert event_pace(PACES["9-ball"]) is PACES["9-ball"]
    with pytest.raises(InputError, match="snooker"):
        finish(double_elimination(4), laws_of(double_elimination(4)), tables=2, pace="snooker")


def test_learning_is_a_normal_posterior() -> None:
    before = Pace(0.0, 6.0, 0.3, 0.15)
    logs = [0.2, -0.1, 0.3, 0.25]
    played = [Timed(7, 42.0 * np.exp(x - 0.3**2 / 2)) for x in logs]
    after = learned_pace(before, played)
    grid = np.linspace(-1.5, 1.5, 20001)
    density = np.exp(-0.5 * (grid / 0.15 + 0.15 / 2) ** 2)  # the evening's factor has mean 1
    for x in logs:
        density *= np.exp(-0.5 * ((x - grid) / 0.3) ** 2)
    density /= density.sum()
    mean = density @ grid
    assert after.per_game == pytest.approx(6.0 * (density @ np.exp(grid)), rel=1e-9)
    assert after.evening_sd == pytest.approx(np.sqrt(density @ (grid - mean) ** 2), abs=1e-9)
    assert learned_pace(before, []) == before
    sure = learned_pace(Pace(0.0, 6.0, 0.0, 0.15), [Timed(10, 66.0)])
    assert sure.per_game == pytest.approx(6.6)
    with pytest.raises(InputError, match="minutes"):
        learned_pace(before, [Timed(7, 0.0)])


# Schedules.


def obvious_schedule(waits, minutes, turnover, tables, priority):
    """Step from moment to moment; at each give free tables to the most urgent ready matches."""
    count = len(minutes)
    start: dict[int, float] = {}
    end: dict[int, float] = {}
    free = [0.0] * tables
    moments = [0.0]
    while len(start) < count:
        now = moments.pop(0)
        while True:
            table = min(range(tables), key=free.__getitem__)
            ready = [
                k
                for k in range(count)
                if k not in start
                and all(end.get(i, np.inf) <= now for i in np.flatnonzero(waits.after[:, k]))
                and all(end.get(i, 0.0) <= now for i in np.flatnonzero(waits.shared[:, k]))
            ]
            if not ready or free[table] > now:
                break
            k = max(ready, key=lambda k: (priority[k], -k))
            start[k], end[k] = now, now + minutes[k]
            free[table] = end[k] + turnover[k]
            moments += [end[k], free[table]]
        moments = sorted(set(moments) - {now})
    return np.array([start[k] for k in range(count)])


@settings(max_examples=examples(40))
@given(st.integers(0, 10**6), st.integers(1, 4), st.booleans(), st.integers(0, 3))
def test_schedule_against_the_obvious_one(seed, tables, for_rounds, kind) -> None:
    bracket = (
        single_elimination(8),
        double_elimination(6, final="single"),
        round_robin(5),
        groups_then_knockout(8, 2),
    )[kind]
    names = [match.name for match in bracket.matches]
    waits = waiting(bracket, names, for_rounds=for_rounds)
    rng = np.random.default_rng(seed)
    minutes = rng.uniform(20, 80, (3, len(names)))
    turnover = rng.uniform(0, 10, (3, len(names)))
    priority = longest_paths(waits, minutes.mean(axis=0))
    planned = schedule(
        waits, minutes, np.ones(minutes.shape, dtype=bool), turnover, np.zeros((3, tables))
    )
    for run in range(3):
        want = obvious_schedule(waits, minutes[run], turnover[run], tables, priority)
        assert planned.start[run] == pytest.approx(want)
        assert planned.end[run] == pytest.approx(want + minutes[run])


def test_rounds_wait_for_the_rounds_that_feed_them() -> None:
    bracket = double_elimination(8)
    names = [match.name for match in bracket.matches]
    free = waiting(bracket, names, for_rounds=False)
    waits = waiting(bracket, names, for_rounds=True)
    at = names.index("L2.1")

    def before(table) -> set[str]:
        return {names[k] for k in np.flatnonzero(table.after[:, at])}

    assert before(free) == {"W2.2", "L1.1"}
    assert before(waits) == {"W2.1", "W2.2", "L1.1", "L1.2"}


# Evenings.


def test_one_match_is_its_own_law() -> None:
    bracket = single_elimination(2)
    pace = Pace(4.0, 6.0, 0.3, 0.15)
    found = finish(bracket, laws_of(bracket, 1), tables=1, pace=pace, turnover=AT_ONCE, runs=4000)
    law = lognorm(np.hypot(0.3, 0.15), scale=10.0 * np.exp(-(0.3**2 + 0.15**2) / 2))
    assert found.bands == pytest.approx(law.ppf([0.1, 0.5, 0.9]), rel=0.02)
    assert found.start("F") == (0.0, 0.0, 0.0, 1.0)


def test_without_chance_the_clock_is_arithmetic() -> None:
    bracket = single_elimination(4)
    laws = laws_of(bracket, 1)  # one game: 15 minutes a match
    two = finish(bracket, laws, tables=2, pace=EXACT, turnover=AT_ONCE)
    one = finish(bracket, laws, tables=1, pace=EXACT, turnover=AT_ONCE)
    assert two.bands == (30.0, 30.0, 30.0)
    assert one.bands == (45.0, 45.0, 45.0)
    assert one.start("F").p50 == 30.0
    assert minutes_later(one, two) == (15.0, 0.0)
    late = finish(bracket, laws, tables=[0.0, 20.0], pace=EXACT, turnover=AT_ONCE)
    assert late.finish(0.5) == 45.0
    rest = finish(bracket, laws, tables=1, pace=EXACT, turnover=Turnover(5.0, 0.0))
    assert rest.finishes.mean() == pytest.approx(55.0, abs=0.4)


def test_turnover_is_short_as_often_as_it_is_in_real_events() -> None:
    bracket = single_elimination(4)
    found = finish(bracket, laws_of(bracket, 1), tables=1, pace=EXACT, runs=4000)
    extra = found.starts[:, found.names.index("F")] - 30.0
    gaps = np.sort(extra)
    assert gaps.mean() == pytest.approx(2 * 0.38 * 10.8, abs=0.3)
    assert (gaps < 1e-9).mean() == pytest.approx(0.62**2, abs=0.02)


def test_a_second_final_is_played_in_half_of_the_evenings() -> None:
    bracket = double_elimination(4)
    found = finish(bracket, laws_of(bracket), tables=2)
    assert found.start("F2").p_played == pytest.approx(0.5, abs=0.01)
    assert np.isnan(found.starts[:, found.names.index("F2")]).mean() == pytest.approx(0.5, abs=0.01)


def test_less_to_play_and_more_tables_end_sooner() -> None:
    bracket = double_elimination(12)
    base = finish(bracket, laws_of(bracket, Races(5)), tables=4)
    short = finish(bracket, laws_of(bracket, Races(5, losers=4)), tables=4)
    table = finish(bracket, laws_of(bracket, Races(5)), tables=5)
    loose = finish(bracket, laws_of(bracket, Races(5)), tables=4, wait_for_rounds=False)
    for better in (short, table, loose):
        gain, error = minutes_later(base, better)
        assert gain > 3 * error > 0
    slow = learned_pace("9-ball", [Timed(7, 70)] * 5)
    later, _ = minutes_later(finish(bracket, laws_of(bracket, Races(5)), tables=4, pace=slow), base)
    assert later > 30.0


def test_from_the_middle_of_an_evening() -> None:
    bracket = single_elimination(4)
    laws = laws_of(bracket, 1)
    found = finish(
        bracket,
        laws,
        tables=2,
        pace=EXACT,
        turnover=AT_ONCE,
        results={"W1.1": "1"},
        playing=[InPlay("W1.2", 10.0)],
        now=20.0,
    )
    # Begun at 10, it takes 15 minutes; the final follows.
    assert found.finish(0.5) == pytest.approx(40.0)
    assert found.start("W1.2").p50 == 10.0
    assert found.start("F").p50 == pytest.approx(25.0)
    assert found.next_start("1").p50 == pytest.approx(25.0)
    assert found.calls() == []
    with pytest.raises(InputError, match=r"W1\.1"):
        found.start("W1.1")


def test_a_match_that_lasts_already_is_a_long_one() -> None:
    bracket = single_elimination(2)
    laws = laws_of(bracket, 3)  # three to five games
    pace = Pace(0.0, 10.0, 0.2, 0.0)

    def left(minutes: float) -> float:
        playing = [InPlay("F", 0.0)]
        now = finish(bracket, laws, tables=1, pace=pace, playing=playing, now=minutes, runs=4000)
        return float(now.finishes.mean() - minutes)

    games = laws["F"].ends[0, 1] + laws["F"].ends[1, 0]
    luck = np.exp(-0.02 + 0.2 * np.random.default_rng(1).standard_normal(400_000))
    drawn = 10.0 * luck * np.random.default_rng(2).choice(len(games), 400_000, p=games)
    for minutes in (0.0, 20.0, 45.0, 70.0):
        want = drawn[drawn > minutes].mean() - minutes
        assert left(minutes) == pytest.approx(want, rel=0.03)


def test_which_match_to_call() -> None:
    """The long way is through the winners' side: call it before the losers' side."""
    bracket = double_elimination(8)
    results = {"W1.1": "1", "W1.2": "4", "W1.3": "2", "W1.4": "3"}
    found = finish(
        bracket,
        laws_of(bracket),
        tables=1,
        pace=EXACT,
        turnover=AT_ONCE,
        results=results,
        wait_for_rounds=False,
    )
    calls = {call.match: call for call in found.calls()}
    assert set(calls) == {"W2.1", "W2.2", "L1.1", "L1.2"}
    assert found.calls()[0].later == 0.0
    assert min(call.later for call in calls.values()) == 0.0
    assert found.finishes.mean() <= min(call.finish_mean for call in calls.values()) + 1.0


def test_nobody_is_at_two_tables_in_a_round_robin() -> None:
    bracket = round_robin(5)
    found = finish(bracket, laws_of(bracket), tables=3, wait_for_rounds=False, runs=50)
    ends = found.starts + np.array([1.0])  # a minute later nobody may have begun elsewhere
    for run in range(50):
        for i, one in enumerate(bracket.matches):
            for j, other in enumerate(bracket.matches):
                if i < j and set(one.slots) & set(other.slots):
                    assert abs(found.starts[run, i] - found.starts[run, j]) > 1.0
    assert ends.shape == found.starts.shape


@pytest.mark.parametrize(
    ("asked", "named"),
    [
        ({"tables": 0}, "tables"),
        ({"tables": 1, "playing": [InPlay("W1.1", 0), InPlay("W1.2", 0)], "now": 5}, "tables"),
        ({"tables": 2, "playing": [InPlay("W2.1", 0)], "now": 5}, "W2.1"),
        ({"tables": 2, "playing": [InPlay("W1.1", 9)], "now": 5}, "W1.1"),
        ({"tables": 2, "results": {"F": "1"}}, "F"),
        ({"tables": 2, "laws": {}}, "W1.1"),
        ({"tables": 2, "runs": 1}, "runs"),
    ],
)
def test_what_cannot_be_timed_is_refused(asked: dict, named: str) -> None:
    bracket = double_elimination(4)
    with pytest.raises(InputError, match=named):
        finish(bracket, **{"laws": laws_of(bracket), **asked})


def test_of_many_matches_the_longest_paths_are_tried_and_the_rest_follow():
    bracket = double_elimination([f"P{k}" for k in range(32)])
    laws = pair_odds(bracket, np.linspace(700.0, 400.0, 32), 5, scale="fargo")
    calls = finish(bracket, laws, tables=4).calls()
    assert sorted(call.match for call in calls) == sorted(f"W1.{k}" for k in range(1, 17))
    assert [bool(np.isnan(call.later)) for call in calls] == [False] * 12 + [True] * 4
    assert calls[0].later == 0.0


def test_calling_a_match_before_its_round_costs_little_while_others_are_under_way() -> None:
    bracket = double_elimination(16)
    laws = laws_of(bracket)
    opening = [match for match in bracket.matches if match.name.startswith("W1.")][:4]
    results = {match.name: bracket.players[match.slots[0]] for match in opening}
    found = finish(
        bracket,
        laws,
        tables=3,
        pace=EXACT,
        turnover=AT_ONCE,
        results=results,
        playing=[InPlay("W1.5", 0.0), InPlay("W1.6", 0.0)],
        now=5.0,
    )
    calls = {call.match: call for call in found.calls()}
    assert {"W1.7", "W2.1", "L1.1"} <= set(calls)
    a_match = 15.0
    assert all(0.0 <= call.later <= 2 * a_match for call in calls.values())
    rows = [found.names.index(name) for name in calls]
    for row in rows:
        start = found.room.on_the_first(20).planned([found.names[row]]).start
        assert (start[found.room.on_the_first(20).evenings.needed] >= 0.0).all()
        assert (start[:, row] == 5.0).all()


def test_two_tables_are_filled_together_and_not_each_as_if_the_other_were_free() -> None:
    """A late match of the round that all wait for is called before one of the next round."""
    bracket = double_elimination(8)
    results = {"W1.1": "1", "W1.2": "4", "W1.3": "2"}
    found = finish(
        bracket, laws_of(bracket), tables=2, pace=EXACT, turnover=AT_ONCE, results=results
    )
    ends = {
        pair: float(found.room.ends(found.room.planned(pair)).mean())
        for pair in itertools.permutations(found.standing.to_play, 2)
    }
    one_by_one = [call.match for call in found.calls()[:2]]
    together = [call.match for call in found.calls(2)[:2]]
    assert "W1.4" not in one_by_one
    assert "W1.4" in together
    assert ends[tuple(together)] < min(ends.values()) + 1.0
    assert ends[tuple(one_by_one)] > ends[tuple(together)] + 5.0
