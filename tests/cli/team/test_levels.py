"""Captains and operators of leagues of skill levels, through the command line."""

from functools import reduce

import numpy as np
import pytest

from evenbreak.handicaps.charts.level_chart import level_chart, points_chart
from evenbreak.handicaps.charts.level_skills import level_skills
from evenbreak.ratings.roster import Roster
from evenbreak.teams.set_laws import Points, Shares, set_laws

OURS = {"Ann": 7, "Bo": 6, "Cleo": 5, "Dan": 4, "Eve": 4, "Fay": 3, "Gus": 2}
THEIRS = {"Uli": 6, "Vic": 5, "Wim": 5, "Xi": 4, "Yu": 3, "Zed": 2}
RATED = {name: 300 + 60 * level for name, level in {**OURS, **THEIRS}.items()}


def written(path, rows, columns="player,level"):
    path.write_text("\n".join([columns, *(",".join(map(str, row)) for row in rows)]) + "\n")
    return str(path)


def sides():
    return ([*zip(*list(team.items())[:5], strict=True)] for team in (OURS, THEIRS))


@pytest.fixture
def lists(tmp_path):
    return tuple(
        written(tmp_path / f"{name}.csv", team.items())
        for name, team in (("ours", OURS), ("theirs", THEIRS))
    )


def test_a_captain_of_levels_asks_with_the_chart_alone(ask, lists):
    told = ask("lineup", *lists, "--chart", "apa_8ball", "--cap", "23", "--at-most", "2:6")
    assert told["set"] == 1
    assert len(told["options"]) == len(OURS)
    assert "Players by skill level" in told["heading"]
    assert "40,000 matches" in " ".join(told["sentences"])
    points = ask("lineup", *lists, "--chart", "apa_8ball", "--cap", "23", "--count", "points")
    assert "A tie counts" in points["sentences"][0]
    assert points["p_win"] != told["p_win"]


def test_who_would_break_the_rule_is_named_and_not_offered(ask, run, lists):
    """With a 7, a 6 and a 5 used, 23 leaves 5 for two sets: only the 2 and the 3 are left."""
    asked = ("--chart", "apa_8ball", "--cap", "23", "--sets", "5", "--order", "A")
    used = ("--used", "Ann,Bo,Cleo,Xi,Yu,Zed", "--score", "2:1")
    told = ask("lineup", *lists, *asked, *used)
    assert {row["name"] for row in told["options"]} == {"Fay", "Gus"}
    assert any("Dan and Eve can't be put up now" in said for said in told["sentences"])
    over = run(
        "lineup", *lists, *asked, "--used", "Ann,Bo,Cleo,Dan,Xi,Yu,Zed,Uli", "--score", "2:2"
    )
    assert over.exit_code != 0
    assert "can no longer stay within its caps" in over.stderr


@pytest.mark.slow
def test_nine_ball_counts_points_and_its_twenty_shares(ask, run, lists):
    asked = ("lineup", *lists, "--chart", "apa_9ball", "--cap", "23", "--sets", "3")
    told = ask(*asked, "--count", "points")
    assert "assumption, not a measurement" in " ".join(told["sentences"])
    assert 0.3 < told["p_win"] < 0.7
    used = ("--used", "Ann,Uli", "--score", "12:8")
    assert ask(*asked, "--count", "points", *used)["set"] == 2
    wrong = run(*asked, "--count", "points", "--used", "Ann,Uli", "--score", "11:9")
    assert "11-9 is impossible" in wrong.stderr
    assert "points, not games" in run(*asked, "--count", "games").stderr


@pytest.mark.slow
def test_ratings_beside_levels_give_the_chances(ask, run, lists, tmp_path):
    rated = [
        written(
            tmp_path / f"rated_{name}.csv",
            [(one, RATED[one], level) for one, level in team.items()],
            "player,rating,level",
        )
        for name, team in (("ours", OURS), ("theirs", THEIRS))
    ]
    asked = ("--chart", "apa_8ball", "--cap", "23")
    told = ask("lineup", *rated, *asked, "--scale", "fargo")
    assert "Ratings on the Fargo scale" in told["heading"]
    own = run("lineup", *rated, *asked, "--scale", "fargo", "--results", "none.csv")
    assert "the results are not used" in own.stderr
    mixed = ask("lineup", rated[0], lists[1], *asked)
    assert mixed["p_win"] == ask("lineup", *lists, *asked)["p_win"]


@pytest.mark.slow
def test_a_round_and_the_caps_of_a_league_of_levels(ask, run, tmp_path):
    two = [
        written(tmp_path / f"{side}.csv", list(team.items())[:5])
        for side, team in (("a", OURS), ("b", THEIRS))
    ]
    told = ask("round", *two, "--chart", "apa_8ball")
    assert "Players by skill level" in told["heading"]
    assert "points, not games" in run("round", *two, "--chart", "apa_9ball").stderr
    assert (
        "with --single-games"
        in run("round", *two, "--single-games", "1", "--count", "points").stderr
    )
    for chart, count in (("apa_8ball", Points()), ("apa_9ball", Shares())):
        told = ask("round", *two, "--chart", chart, "--count", "points")
        a, b = (Roster(names, [0.0] * 5, level=levels) for names, levels in sides())
        levels = level_skills(chart) if chart == "apa_8ball" else None
        race = level_chart(chart) if levels else points_chart(chart)
        laws = set_laws(a, b, race, count=count, levels=levels).sum(axis=2)
        lead = reduce(np.convolve, [laws[k, k] for k in range(5)])
        even = next(row for row in told["starts"] if row["start_1"] == 0)
        assert even["p_win_1"] == pytest.approx(lead[len(lead) // 2 + 1 :].sum())
        assert even["p_tie"] == pytest.approx(lead[len(lead) // 2])
    teams = written(
        tmp_path / "teams.csv",
        [("Racks", *one) for one in OURS.items()] + [("Cues", *one) for one in THEIRS.items()],
        "team,player,level",
    )
    by_name = (
        "racks",
        "Cues",
        "--roster",
        teams,
        "--chart",
        "apa_8ball",
        "--cap",
        "18",
        "--sets",
        "4",
    )
    told = ask("lineup", *by_name)
    assert told["set"] == 1
    assert {row["name"] for row in told["options"]} <= set(OURS)
    away = ask("lineup", *by_name, "--absent", "ann,Zed")
    assert {row["name"] for row in away["options"]} <= set(OURS) - {"Ann"}
    some = [
        written(
            tmp_path / f"{side}.csv", [one for one in team.items() if one[0] not in ("Ann", "Zed")]
        )
        for side, team in (("here", OURS), ("there", THEIRS))
    ]
    assert away["options"] == ask("lineup", *some, *by_name[4:])["options"]
    assert "is in neither team" in run("lineup", *by_name, "--absent", "Xaver").stderr
    assert "is neither a file nor a team" in run("lineup", "Rackets", *by_name[1:]).stderr
    asked = ("caps", teams, "--chart", "apa_8ball", "--cap", "16", "--sets", "4")
    for more in ((), ("--count", "points"), ("--at-most", "1:6")):
        told = ask(*asked, *more)
        racks = next(row for row in told["teams"] if row["team"] == "Racks")
        assert racks["level_sum"] == 22
        assert racks["cap_worth"] < 0


def test_own_charts_of_levels_and_ones_own_results(ask, run, lists, tmp_path):
    apa = level_chart("apa_8ball")
    rows = [(a, b, *apa.race(a, b)) for a in apa.levels for b in apa.levels if a >= b]
    own = written(tmp_path / "own.csv", rows, "level,opponent_level,needs,opponent_needs")
    named, mine = (
        ask("lineup", *lists, "--chart", chart, "--sets", "3")["p_win"]
        for chart in ("apa_8ball", own)
    )
    assert mine == named
    said = run("lineup", *lists, "--chart", "npl_8", "--results", own).stderr
    assert "--results is for chances based on skill levels" in said
    said = run("lineup", *lists, "--chart", "apa_8ball", "--scale", "3").stderr
    assert "--scale is for ratings" in said


def test_a_level_that_the_chart_does_not_have_is_named(run, lists, tmp_path):
    wrong = written(tmp_path / "wrong.csv", [("Ann", 7), ("Bo", 9), ("Cleo", 4)])
    result = run("lineup", wrong, lists[1], "--chart", "apa_8ball")
    assert "Bo' has skill level 9, but apa_8ball has levels 2, 3" in result.stderr


def test_the_level_of_a_newcomer_counts_under_a_cap_too(ask, run, lists, tmp_path):
    rules = ("--chart", "apa_8ball", "--cap", "13", "--sets", "3")
    new = written(tmp_path / "new.csv", {**OURS, "Dan": "", "Eve": ""}.items())
    told = ask("lineup", new, lists[1], *rules, "--starter", "4")
    assert told["options"] == ask("lineup", *lists, *rules)["options"]
    assert "get one with --starter" in run("lineup", new, lists[1], *rules).stderr
