"""What is to be expected of a chip night: the odds are those of the room, the finish its racks."""

from __future__ import annotations

from dataclasses import replace
from itertools import permutations

import numpy as np
import pytest

from evenbreak.answers.chips import ChipField, chip_odds_answer
from evenbreak.ratings import SCALES
from evenbreak.tournaments import CHIP_CHARTS, play_chips, rack_chances
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Drawn, Entrant, Event, Opened, Plan
from evenbreak.tournaments.evening.fold import evening
from evenbreak.tournaments.evening.outlook import Outlook

AT = "2025-03-01T19:30:00"
PHARAOHS = CHIP_CHARTS["pharaohs"]


def drawn(ratings, tables=4, error=0.0, order=None):
    entrants = tuple(Entrant(f"P{k}", float(r), error) for k, r in enumerate(ratings))
    plan = Plan("chips", 1, scale="fargo", tables=tables, chips=PHARAOHS)
    names = tuple(one.name for one in entrants)
    seats = names if order is None else tuple(names[k] for k in order)
    return [Event(AT, Opened(plan, entrants)), Event(AT, Drawn(seats, None))]


def test_odds_at_the_start_are_those_of_chips_odds() -> None:
    ratings = np.array([720.0, 680.0, 600.0])
    field = ChipField(["P0", "P1", "P2"], ratings, SCALES["fargo"], 4, "here")
    rows = chip_odds_answer(field, PHARAOHS).to_frame().set_index("name")
    title = np.zeros(3)
    for order in permutations(range(3)):  # any draw is as likely as any other
        odds = Outlook(evening(drawn(ratings, order=order)), AT).odds
        assert odds.exact
        title[list(order)] += odds.title / 6
    for k, p in enumerate(title):
        row = rows.loc[f"P{k}"]
        assert row["p_title"] == pytest.approx(p, abs=4 * row["p_title_error"])


def test_odds_of_a_larger_field_are_those_of_its_line() -> None:
    ratings = np.linspace(700, 400, 10)
    odds = Outlook(evening(drawn(ratings)), AT).odds
    chips, racks = PHARAOHS.chips(ratings), rack_chances(ratings)
    played = play_chips(chips, racks, tables=4, line=range(10))
    assert np.array_equal(odds.p_place, played.p_place)
    assert np.array_equal(odds.error, played.error)
    unsure = Outlook(evening(drawn(ratings, error=60.0)), AT)
    assert np.array_equal(unsure.as_if_sure.p_place, odds.p_place)
    assert 0.002 < np.abs(unsure.odds.title - odds.title).max() < 0.05
    assert unsure.odds.p_place.sum(axis=0) == pytest.approx(np.ones(10))


def test_odds_and_finish_during_the_evening() -> None:
    events = drawn([700, 650, 640, 600, 500], tables=2)
    before = Outlook(evening(events), AT)
    for minute, (table, winner) in enumerate([("1", "P1"), ("2", "P3"), ("1", "P1")], 1):
        what = moves.result(evening(events), table, winner)
        events.append(Event(f"2025-03-01T19:{30 + 9 * minute}:00", what))
    now = Outlook(evening(events), events[-1].at)
    assert [one.minutes for one in now.timed] == [9.0, 18.0, 18.0]
    assert now.odds.title[0] < before.odds.title[0]  # who has lost a chip of two
    gone = [*events, Event(events[-1].at, moves.drop(now.state, "P4"))]
    left = Outlook(evening(gone), events[-1].at)
    assert left.odds.p_place[:, 4].tolist() == [0, 0, 0, 0, 1]
    assert left.odds.p_place.sum(axis=1) == pytest.approx(np.ones(5))
    one = np.median(now.chip_finishes(tables=1))
    assert one > np.median(now.chip_finishes()) > 27.0
    slow = replace(now, now="2025-03-01T20:30:00")
    assert np.median(slow.chip_finishes()) == pytest.approx(
        np.median(now.chip_finishes()) + 33.0, abs=1e-6
    )


def test_a_night_is_as_long_as_its_racks() -> None:
    """Two players of one chip each: one rack, which takes as long as it takes."""
    events = drawn([900, 900], tables=1)
    events += [Event(AT, moves.result(evening(events), "1", w)) for w in ("P0",)]
    events.append(Event(AT, moves.result(evening(events), "1", "P1")))
    finishes = Outlook(evening(events), AT).chip_finishes()
    assert finishes.mean() == pytest.approx(0.97 * (3.8 + 5.58), rel=0.02)
