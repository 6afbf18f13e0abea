"""What earlier nights at a venue say of the pace: the posterior, its cover, how they are kept."""

from __future__ import annotations

import itertools
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import norm

from evenbreak.errors import DataError
from evenbreak.files.store.tournament import (
    earlier_nights,
    event_rows,
    new_tournament,
    read_tournament,
)
from evenbreak.matches.pace import Turnover
from evenbreak.tournaments import double_elimination, event_pace, finish, pair_odds
from evenbreak.tournaments.clock.event_pace import EarlierNight
from evenbreak.tournaments.evening.earlier import night_played, nights_until
from evenbreak.tournaments.evening.events import Changed, Entrant, Event, Opened, Plan, Undone
from evenbreak.tournaments.evening.fold import evening
from evenbreak.tournaments.evening.outlook import Outlook
from rows import each_of
from tournament_nights import AT, timed_night

DISCIPLINES = ("8-ball", "9-ball", "10-ball")


def nights(discipline: str, logs: list[float]) -> list[EarlierNight]:
    return [
        EarlierNight(f"2025-03-{k:02d}T19:30:00", discipline, float(np.exp(y)))
        for k, y in enumerate(logs, 1)
    ]


def opened(form: str = "single", players: int = 8, **plan: object) -> list[Event]:
    entrants = tuple(Entrant(f"P{k}", 500.0) for k in range(1, players + 1))
    asked = {"scale": "fargo", "tables": 2, **plan}
    return [Event(AT, Opened(Plan(form, 5, **asked), entrants))]  # type: ignore[arg-type]


def test_the_pace_of_a_venue_is_a_normal_posterior() -> None:
    logs = [0.2, 0.05, 0.12]
    usual, after = event_pace("9-ball"), event_pace("9-ball", nights("9-ball", logs))
    venue = usual.evening_sd / np.sqrt(2)
    grid = np.linspace(-1.0, 1.0, 20001)
    density = norm.pdf(grid, 0.0, venue)
    for y in logs:  # a night varies by twice the variance of a venue
        density *= norm.pdf(y, grid, np.sqrt(2) * venue)
    density /= density.sum()
    mean = float(density @ grid)
    left = float(density @ (grid - mean) ** 2)
    assert after.evening_sd**2 == pytest.approx(usual.evening_sd**2 / 2 + left, rel=1e-6)

    def middle(pace):
        return pace.per_game * np.exp(-(pace.evening_sd**2) / 2)

    assert np.log(middle(after) / middle(usual)) == pytest.approx(mean, abs=1e-9)
    assert event_pace("9-ball", nights("8-ball", logs)) == usual
    assert event_pace(usual, nights("9-ball", logs)) is usual


@pytest.mark.slow
@each_of("discipline, nights_known", itertools.product(DISCIPLINES, (0, 2, 6)))
def test_nine_evenings_of_ten_end_in_time(discipline: str, nights_known: int) -> None:
    """Venues and nights drawn with the stated spread; without turnovers a pace only stretches."""
    bracket, tables, at_once = double_elimination(8), 3, Turnover(0.0, 0.0)
    laws = pair_odds(bracket, list(np.random.default_rng(5).normal(500, 80, 8)), 5)

    def ends(pace, seed):
        asked = {"tables": tables, "turnover": at_once, "runs": 4000, "seed": seed}
        return np.log(finish(bracket, laws, pace=pace, **asked).finishes)

    usual = event_pace(discipline)
    luck = ends(replace(usual, evening_sd=0.0), 1) - usual.evening_sd**2 / 2
    rng = np.random.default_rng(7)
    venues = 20_000
    venue, night = rng.normal(0, usual.evening_sd / np.sqrt(2), (2, venues, nights_known + 1))
    took = rng.choice(luck, (venues, nights_known + 1)) + venue[:, :1] + night
    middle = float(np.median(ends(usual, 2)))
    seen = (took[:, :-1] - middle).mean(axis=1) if nights_known else np.zeros(venues)
    same = event_pace(discipline, nights(discipline, [0.0] * nights_known))
    early, middle, late = np.quantile(ends(same, 2), (0.1, 0.5, 0.9))
    moved = nights_known * seen / (nights_known + 2)
    real = took[:, -1]
    assert (real <= late + moved).mean() == pytest.approx(0.90, abs=0.02)
    assert (real < early + moved).mean() == pytest.approx(0.10, abs=0.02)
    assert np.median(real - middle - moved) == pytest.approx(0.0, abs=0.01)


def test_the_usual_pace_agrees_with_what_was_measured() -> None:
    """The old pace ended in time .82 of the evenings, .797 within its band, 8 % early.

    By discipline only the first figure is known, .78 and .955. Either the middles differ or the
    spreads: the pace has to do for both.
    """
    over, under = 0.215, -0.21  # of the old band, in logs
    spread = (over - under) / (norm.ppf(0.82) - norm.ppf(0.82 - 0.797))
    off = over - norm.ppf(0.82) * spread
    assert (np.exp(off), spread) == pytest.approx((1.08, 0.146), abs=0.01)
    for cover, level, sd in ((0.78, 0.97, 0.12), (0.955, 0.895, 0.09)):
        late = np.log(level / 0.876) + norm.ppf(0.9) * np.hypot(sd, 0.08)
        one_spread, one_middle = 0.136, (over - off) / norm.ppf(cover)
        middles = norm.cdf(late, over - norm.ppf(cover) * one_spread, one_spread)
        spreads = norm.cdf(late, off, one_middle)
        assert middles == pytest.approx(0.90, abs=0.025)
        assert spreads == pytest.approx(0.90, abs=0.025)


def test_a_night_is_measured_against_the_usual_pace() -> None:
    events = timed_night(opened("double"), AT, slow=1.3)
    night = night_played(evening(events))
    assert night is not None
    took = Outlook(evening(events), events[-1].at).minutes(events[-1].at)
    planned = Outlook(evening(events[:2]), AT).finish(pace=event_pace("9-ball")).finish(0.5)
    assert (night.at, night.discipline) == (AT, "9-ball")
    assert night.ratio == pytest.approx(took / planned)
    slow_before = [EarlierNight("2025-02-01T19:30:00", "9-ball", 1.5)]
    first = replace(events[0].what, plan=replace(events[0].what.plan, earlier=tuple(slow_before)))
    planned_slower = evening([Event(AT, first), *events[1:]])
    assert night_played(planned_slower) == night  # not against what those before it made of it
    assert nights_until([planned_slower]) == (*slow_before, night)


def _typed_in(events: list[Event]) -> list[Event]:
    return [replace(one, at=AT) for one in events]


@each_of(
    "form, change",
    [
        ("double", lambda events: events[:-1]),
        ("double", lambda events: [e for e in events if "Called" not in type(e.what).__name__]),
        ("double", lambda events: [*events[:9], Event(AT, Changed(tables=3)), *events[9:]]),
        ("double", _typed_in),
        ("double", lambda events: [*events, Event(events[-1].at, Undone())]),
        ("groups", lambda events: [e for e in events if getattr(e.what, "match", "")[:1] != "K"]),
    ],
)
def test_nights_that_say_nothing_of_the_pace(form: str, change) -> None:
    plan = {"groups": 2} if form == "groups" else {}
    events = timed_night(opened(form, **plan), AT)
    assert night_played(evening(change(events))) is None


def test_a_new_tournament_keeps_the_nights_before_it(tmp_path: Path) -> None:
    first, second = tmp_path / "first.db", tmp_path / "second.db"
    new_tournament(first, timed_night(opened(), AT, slow=1.2))
    known = earlier_nights([first])
    later = "2025-03-08T19:30:00"
    new_tournament(second, timed_night(opened(earlier=known), later, slow=1.2, seed=2))
    state = read_tournament(second)
    assert state.plan.earlier == known
    assert Outlook(state, later).pace == event_pace("9-ball", known)
    both = earlier_nights([second])
    assert [one.at for one in both] == [AT, later]
    assert earlier_nights([tmp_path]) == both  # each night once
    (tmp_path / "other.db").write_text("nothing")
    assert earlier_nights([tmp_path]) == both
    with pytest.raises(DataError, match=r"other\.db"):
        earlier_nights([tmp_path / "other.db"])
    for row in event_rows(state.events):
        assert "earlier" in json.loads(row[3]).get("plan", {"earlier": ()})


def test_files_without_earlier_nights_are_as_they_were() -> None:
    state = evening(opened())
    assert state.plan.earlier == ()
    assert Outlook(state, AT).pace == event_pace("9-ball")
