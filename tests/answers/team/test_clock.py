"""When the sets of a team night start and it ends, against nights played out one by one."""

from datetime import datetime, timedelta

import numpy as np
import pytest

from evenbreak.answers.team.clock import clock_words, night_clock
from evenbreak.teams.evening.events import Begun, Event, PutUp, Result, What
from evenbreak.teams.evening.fold import TeamEvening, team_evening
from evenbreak.tournaments.clock.event_pace import Timed, learned_pace
from team_nights import CUES, RACKS, plan

START = datetime(2025, 3, 1, 19, 30)


def at(minutes: float) -> str:
    return (START + timedelta(minutes=minutes)).isoformat()


def night(*what: tuple[float, What], **how: object) -> TeamEvening:
    """Return the state after events at minutes since the start."""
    events = [Event(at(0), Begun(plan(**how))), *(Event(at(when), one) for when, one in what)]
    state = team_evening(events)
    assert state is not None
    return state


def named(number: int, ours: str, theirs: str, when: float) -> list[tuple[float, What]]:
    return [(when - 1, PutUp(0, number, (ours,))), (when, PutUp(1, number, (theirs,)))]


def turnover(rng: np.random.Generator) -> float:
    """Return a pause of real events: none in 62 of 100 cases, else of median 7.5, mean 10.8."""
    return 0.0 if rng.random() < 0.62 else 7.5 * np.exp(rng.standard_normal() * 0.854)


def played_out(runs: int) -> tuple[np.ndarray, np.ndarray]:
    """Return when set 2 starts and when the night ends, after 40 minutes of set 1, on one table."""
    rng = np.random.default_rng(5)
    pace = learned_pace("8-ball", [])
    starts, ends = [], []
    while len(ends) < runs:
        slow = np.exp(rng.normal(-(pace.evening_sd**2) / 2, pace.evening_sd))

        def minutes(p: float, slow: float = slow) -> float:
            score = [0, 0]
            while max(score) < 4:
                score[rng.random() >= p] += 1
            luck = np.exp(rng.normal(-(pace.match_sd**2) / 2, pace.match_sd))
            return slow * luck * (pace.overhead + pace.per_game * sum(score))

        def chance(ours: str, theirs: str) -> float:
            one, other = (
                dict(zip(team.players, team.ratings, strict=True)) for team in (RACKS, CUES)
            )
            return 1 / (1 + 2 ** ((other[theirs] - one[ours]) / 100))

        first = 0.0
        while first < 40.0:  # it is still being played; only finished sets say how slow a night is
            first = minutes(chance("Ann", "Wim"))
        now = first + turnover(rng)
        starts.append(now)
        for number in (2, 3):
            ours, theirs = rng.choice(["Bo", "Cleo", "Dan"]), rng.choice(["Uli", "Vic"])
            now += minutes(chance(ours, theirs)) + (turnover(rng) if number == 2 else 0.0)
        ends.append(now)
    return np.array(starts), np.array(ends)


def test_times_are_those_of_nights_played_out() -> None:
    state = night(*named(1, "Ann", "Wim", 0))
    found = night_clock(state, at(40))
    starts, ends = played_out(4000)
    for band, times in ((found.starts[2], starts), (found.end, ends)):
        wanted = np.quantile(times, (0.1, 0.5, 0.9)) - 40
        assert list(band) == pytest.approx(wanted, abs=3.0)
    assert list(found.starts) == [2, 3]


def test_sets_on_two_tables_do_not_wait_for_each_other() -> None:
    both = [*named(1, "Ann", "Wim", 0), *named(2, "Bo", "Vic", 2)]
    one, two = (night_clock(night(*both, tables=tables), at(30)) for tables in (1, 2))
    assert list(one.starts) == [2, 3]
    assert list(two.starts) == [3]
    assert two.end.middle < one.end.middle - 20


def test_a_free_table_means_now_and_a_slow_night_is_learned_from() -> None:
    """Set 2 is named while set 1 is on the only table, and begins when that ends."""
    state = night()
    assert str(clock_words(state, night_clock(state, at(5)))[0]) == "Set 1 can start now."
    ends = []
    for took in (40, 100):
        so_far = [*named(1, "Ann", "Wim", 0), *named(2, "Bo", "Vic", 10)]
        state = night(*so_far, (took, Result(1, (4, 2))))
        found = night_clock(state, at(took))
        assert list(found.starts) == [3]
        ends.append(found.end.middle)
        pace = learned_pace("8-ball", [Timed(6, took)])
        assert found.starts[3].middle == pytest.approx(pace.mean_minutes(5.7), rel=0.15)
    assert ends[1] > ends[0] + 10


def test_the_loser_names_first_only_when_the_set_is_over() -> None:
    asked = named(1, "Ann", "Wim", 0)
    by_loser = night_clock(night(*asked, order="loser", tables=3), at(30))
    in_turn = night_clock(night(*asked, tables=3), at(30))
    assert in_turn.starts[2].late < 1.0
    assert by_loser.starts[2].middle > 10.0


def test_a_night_that_is_over_has_no_times() -> None:
    pairs = zip((1, 2, 3), ("Ann", "Bo", "Cleo"), ("Uli", "Vic", "Wim"), strict=True)
    what: list[tuple[float, What]] = []
    for number, ours, theirs in pairs:
        what += [
            *named(number, ours, theirs, 60 * number),
            (60 * number + 50, Result(number, (4, 1))),
        ]
    state = night(*what)
    assert clock_words(state, night_clock(state, at(240))) == []
