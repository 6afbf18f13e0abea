"""The options of `simulate` and the season that they stand for."""

import click
import pytest

from evenbreak.cli.league.simulate_season import (
    WEEKS,
    matches_to_play,
    refuse_contradictions,
    season_of_options,
)
from evenbreak.files.lists.season import read_league
from evenbreak.handicaps.systems.catalogue import system_of
from evenbreak.league.schedule import FixedSchedule, RandomPairing, RoundRobin
from places import DATA

NOTHING = {
    "system": system_of("npl"),
    "scale": None,
    "chart": None,
    "schedule_path": None,
    "round_robin": False,
    "by_lot": False,
    "matches": None,
    "weeks": None,
    "racks": False,
}
FIXTURES = str(DATA / "demo_schedule.csv")


@pytest.fixture(scope="module")
def league():
    return read_league(str(DATA / "demo_league_roster.csv"))


def season_of(league, **asked):
    return season_of_options(league, NOTHING | asked)


@pytest.mark.parametrize(
    ("asked", "kind", "weeks", "matches"),
    [
        ({}, RoundRobin, WEEKS, 240),  # 16 players: 8 matches a week
        ({"weeks": 10, "matches": 3}, RoundRobin, 10, 240),
        ({"by_lot": True, "weeks": 2}, RandomPairing, 2, 16),
        ({"schedule_path": FIXTURES}, FixedSchedule, 15, 120),
        ({"schedule_path": FIXTURES, "weeks": 5}, FixedSchedule, 5, 40),
        ({"schedule_path": FIXTURES, "weeks": 20}, FixedSchedule, 20, 120),
    ],
)
def test_who_plays_whom_for_how_long(league, asked, kind, weeks, matches):
    season, warnings = season_of(league, **asked)
    assert isinstance(season.schedule, kind)
    assert (season.weeks, matches_to_play(season)) == (weeks, matches)
    assert any("week" in warning for warning in warnings) == (
        "weeks" in asked and kind is FixedSchedule
    )


def test_a_match_is_drawn_at_once_or_rack_by_rack(league):
    assert season_of(league)[0].play == "matches"
    assert season_of(league, racks=True)[0].play == "racks"


@pytest.mark.parametrize(
    ("places", "asked", "named"),
    [
        (("r", 1, None), {"schedule_path": "s", "by_lot": True}, "--schedule and --random"),
        (("r", 1, None), {"round_robin": True, "by_lot": True}, "--round-robin and --random"),
        (("r", 1, None), {"schedule_path": "s", "matches": 2}, "--schedule and --matches"),
        (("r", 2, "tcp://x"), {}, "--dask and --jobs"),
        (("r", 1, " "), {}, "--dask"),
        (("-", 1, None), {"chart": "-"}, "standard input"),
    ],
)
def test_options_that_exclude_each_other(places, asked, named):
    with pytest.raises(click.UsageError, match=named):
        refuse_contradictions(*places, NOTHING | asked)
    refuse_contradictions("r", 1, None, NOTHING)
