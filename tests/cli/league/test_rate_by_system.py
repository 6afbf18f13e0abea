"""`rate --system` with systems that look at all results: ratings, levels, averages, one's own."""

import csv
import io
import re

import pytest

LEVELS = "player,skill level,fargo rating,matches\nAnn,7,640,\nBo,4,520,\nCy,5,560,30\nDi,3,,0\n"
NIGHTS = """date,player_a,player_b,score_a,score_b,race_a,race_b
2026-09-01,Ann,Bo,5,1,5,2
2026-09-01,Cy,Di,1,2,4,2
2026-09-08,Ann,Cy,2,3,5,3
2026-09-08,Bo,Di,0,2,3,2
"""
OWN = """
from evenbreak.handicaps import NoHandicap

class Wins(NoHandicap):
    name = "wins"
    def update(self, history):
        return history.initial + history.counts("won", lambda matches: matches.won_a)

class Blank(NoHandicap):
    def update(self, history):
        return history.ratings * float("nan")

class Half:
    name = "half"
"""


@pytest.fixture
def league(tmp_path, monkeypatch):
    (tmp_path / "list.csv").write_text(LEVELS, encoding="utf-8")
    (tmp_path / "nights.csv").write_text(NIGHTS, encoding="utf-8")
    (tmp_path / "our_league.py").write_text(OWN, encoding="utf-8")
    monkeypatch.chdir(tmp_path)


def after(run, system):
    found = run("rate", "nights.csv", "--system", system, "--roster", "list.csv")
    assert found.exit_code == 0, found.stderr
    return {row["player"]: row for row in csv.DictReader(io.StringIO(found.stdout))}


@pytest.mark.usefixtures("league")
def test_levels_are_reviewed_night_by_night(run):
    rows = after(run, "level-review")
    assert {name: row["level"] for name, row in rows.items()} == {
        "Ann": "7",
        "Bo": "4",
        "Cy": "5",
        "Di": "5",  # a newcomer: two matches, and at most a level a night
    }
    assert (rows["Di"]["rating_before"], rows["Di"]["change"]) == ("3", "2")
    assert rows["Ann"]["rating"] == "640"


@pytest.mark.usefixtures("league")
def test_all_games_are_refitted(run):
    rows = after(run, "fargo-like")
    ratings = {name: float(row["rating"]) for name, row in rows.items()}
    assert ratings["Di"] > 525.0 > ratings["Bo"] - 10.0
    assert float(rows["Bo"]["change"]) < 0.0
    assert rows["Di"]["rating_before"] == "525"


@pytest.mark.slow
@pytest.mark.usefixtures("league")
def test_a_class_of_ones_own(run):
    rows = after(run, "our_league:Wins")
    assert [rows[name]["change"] for name in ("Ann", "Bo", "Cy", "Di")] == ["1", "0", "1", "2"]


@pytest.mark.usefixtures("league")
@pytest.mark.parametrize(
    ("system", "named"),
    [
        ("our_league:Blank", "returned nan for player 1"),
        ("our_league:Half", r"class Half\(System\)"),
        ("our_league:Other", "our_league has no Other"),
        ("their_league:Wins", "Start evenbreak in the folder that has their_league.py"),
        ("apa-like", "Use level-review"),
        ("level-review window=0", "window must be a whole number from 1 to 200; you gave 0"),
        ("chess", "system must be npl, step"),
    ],
)
def test_what_cannot_be_used_is_refused(run, system, named):
    found = run("rate", "nights.csv", "--system", system, "--roster", "list.csv")
    assert found.exit_code != 0
    assert re.search(named, " ".join(found.stderr.split()))


@pytest.mark.usefixtures("league")
def test_a_list_without_levels_is_refused_by_a_system_of_levels(run, tmp_path):
    (tmp_path / "list.csv").write_text("player,rating\nAnn,640\nBo,520\nCy,560\nDi,500\n")
    found = run("rate", "nights.csv", "--system", "tap-like", "--roster", "list.csv")
    assert "Add a level column" in found.stderr


@pytest.mark.usefixtures("league")
def test_ratings_that_are_no_averages_are_said_to_be_left_out(run):
    found = run("rate", "nights.csv", "--system", "averages", "--roster", "list.csv")
    text = " ".join(found.stderr.split())
    assert "3 of the ratings can't be ratings in the system averages, such as 640" in text
    assert (
        "can't be ratings"
        not in run("rate", "nights.csv", "--system", "fargo-like", "--roster", "list.csv").stderr
    )
