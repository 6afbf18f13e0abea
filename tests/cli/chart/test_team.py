import json

import pytest

from evenbreak.handicaps import team_handicap


def test_every_option_reaches_the_handicap(run):
    line = "510 462 --match-ups 5 --single-games 1 --won 10 --lost 3.5 --scale 120 --json"
    found = json.loads(run("chart", "team", *line.split()).stdout)
    theirs = team_handicap(
        510, 462, match_ups=5, games=1, points_won=10, points_lost=3.5, scale=120
    )
    assert (found["points"], found["scored_1"]) == (theirs.points, theirs.scored_1)


def test_the_averages_are_those_of_the_library(run):
    found = json.loads(run("chart", "team", "417", "447", "--json").stdout)
    assert found["even_points"] == team_handicap(417, 447).even_points


@pytest.mark.parametrize(
    ("line", "wrong"),
    [("417", "AVERAGE_2"), ("417 high", "'high'"), ("417 447 --won 1 --lost 5", "lost")],
)
def test_what_is_refused(run, line, wrong):
    result = run("chart", "team", *line.split())
    assert (result.exit_code, result.stdout) == (2, "")
    assert wrong in result.stderr


def test_the_old_spelling_comes_with_a_note(run):
    old, new = (
        run("chart", "team", "417", "447", name, "1") for name in ("--games", "--single-games")
    )
    assert old.stdout == new.stdout
    assert "Note: --games is now called --single-games." in old.stderr
