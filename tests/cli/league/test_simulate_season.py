"""The options of `simulate` and the season that they stand for."""

import pytest

from evenbreak.cli.league.simulate import matches_to_play, season_of
from evenbreak.fields.question import AskedError
from evenbreak.files.lists.season import read_season_players
from evenbreak.league.schedule import FixedSchedule, RandomPairing, RoundRobin
from evenbreak.questions.league import WEEKS, Simulate
from places import DATA

FIXTURES = str(DATA / "demo_schedule.csv")


@pytest.fixture(scope="module")
def league():
    return read_season_players(str(DATA / "demo_league_roster.csv"))


def asked(roster="r", **fields):
    return Simulate(roster=roster, out="season", **fields)


@pytest.mark.parametrize(
    ("fields", "kind", "weeks", "matches"),
    [
        ({}, RoundRobin, WEEKS, 240),  # 16 players: 8 matches a week
        ({"weeks": 10, "matches": 3}, RoundRobin, 10, 240),
        ({"random": True, "weeks": 2}, RandomPairing, 2, 16),
        ({"schedule": FIXTURES}, FixedSchedule, 15, 120),
        ({"schedule": FIXTURES, "weeks": 5}, FixedSchedule, 5, 40),
        ({"schedule": FIXTURES, "weeks": 20}, FixedSchedule, 20, 120),
    ],
)
def test_who_plays_whom_for_how_long(league, fields, kind, weeks, matches):
    season, warnings = season_of(league, asked(**fields))
    assert isinstance(season.schedule, kind)
    assert (season.weeks, matches_to_play(season)) == (weeks, matches)
    assert any("week" in warning for warning in warnings) == (
        "weeks" in fields and kind is FixedSchedule
    )


def test_a_match_is_drawn_at_once_or_rack_by_rack(league):
    assert season_of(league, asked())[0].play == "matches"
    assert season_of(league, asked(rack_by_rack=True))[0].play == "racks"


@pytest.mark.parametrize(
    ("fields", "named"),
    [
        ({"schedule": "s", "random": True}, "schedule and random"),
        ({"round_robin": True, "random": True}, "round_robin and random"),
        ({"schedule": "s", "matches": 2}, "schedule and matches"),
        ({"jobs": 2, "dask": "tcp://x"}, "dask and jobs"),
        ({"dask": " "}, "dask"),
        ({"roster": "-", "chart": "-"}, "standard input"),
    ],
)
def test_options_that_exclude_each_other(fields, named):
    with pytest.raises(AskedError, match=named):
        asked(**fields)
    asked()
