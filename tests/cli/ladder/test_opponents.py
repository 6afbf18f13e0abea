"""Who a player on the ladder meets: opponents of a league, of equal skill, too far away."""

import csv

import pytest

from evenbreak.handicaps import chart
from evenbreak.handicaps.ladders.ladder import Ladder
from evenbreak.handicaps.ladders.opponents import opponents_of
from places import DATA

ROSTER = DATA / "demo_roster.csv"


def test_opponents_of_a_league(ladder):
    answer = ladder("--chart", "npl_10", "--league", str(ROSTER), "--skill", "60")
    with ROSTER.open(encoding="utf-8") as file:
        ratings = [float(row["rating"]) for row in csv.DictReader(file) if row["rating"]]
    built = Ladder("npl", chart("npl_10"), opponents=opponents_of(ratings, about=60))
    assert answer["sd"] == built.law().sd
    assert answer["opponents"] == "league"
    median = ladder("--chart", "npl_10", "--league", str(ROSTER))
    assert median["sd"] != answer["sd"]


def test_a_league_without_ratings_is_bad_data(run, tmp_path):
    roster = tmp_path / "new.csv"
    roster.write_text("player,rating\nAnn,\nBo,\n")
    result = run("ladder", "--league", str(roster))
    assert result.exit_code == 3
    assert str(roster) in result.stderr


@pytest.fixture
def fargo_league(tmp_path):
    path = tmp_path / "fargo.csv"
    path.write_text("player,rating\nAnn,600\nBo,500\nCy,550\n", encoding="utf-8")
    return str(path)


def test_a_league_that_looks_like_another_scale_is_refused(run, ladder, fargo_league):
    for compare in ((), ("--compare",)):
        result = run("ladder", "--league", fargo_league, *compare)
        assert (result.exit_code, result.stdout) == (2, "")
        assert "91% of the time by NPL ratings, 67% by Fargo ratings" in result.stderr
    fits = ("--chart", "fargo_r6_hot", "--scale", "fargo")
    assert ladder(*fits, "--league", fargo_league)["warnings"] == []


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("compare", [(), ("--compare",)])
@pytest.mark.parametrize(
    ("skill", "code", "named"),
    [("80", 1, "Give a --skill closer to theirs"), ("5000", 2, "--skill is 5000")],
)
def test_opponents_who_are_too_far_are_refused(run, tmp_path, compare, skill, code, named):
    path = tmp_path / "far.csv"
    path.write_text("player,rating,scale\nAnn,600,npl\nBo,500,npl\nCy,550,npl\n")
    result = run("ladder", "--league", str(path), "--skill", skill, *compare)
    assert (result.exit_code, result.stdout) == (code, "")
    assert named in " ".join(result.stderr.split())


def test_opponents_of_equal_skill_who_are_rated_wrongly(ladder):
    assert round(ladder("--chart", "npl_10", "--equal-skill")["sd"], 3) == 4.417
