"""A season of teams through the command line."""

import pytest

from places import DATA

RESULTS, SCHEDULE = str(DATA / "demo_team_results.csv"), str(DATA / "demo_team_schedule.csv")


def test_chances_of_the_table(ask):
    told = ask("season", RESULTS, SCHEDULE, "--up", "2", "--down", "1", "--seasons", "2000")
    rows = told["teams"]
    assert not told["exact"]
    assert sum(row["p_title"] for row in rows) == pytest.approx(1.0)
    assert sum(row["p_up"] for row in rows) == pytest.approx(2.0)
    assert sum(row["p_down"] for row in rows) == pytest.approx(1.0)
    assert {row["team"] for row in told["tonight"]} == {row["team"] for row in rows}


def test_the_last_round_is_exact_if_the_strengths_are(ask, tmp_path):
    lines = (DATA / "demo_team_schedule.csv").read_text().splitlines()
    last = tmp_path / "last.csv"
    last.write_text("\n".join([lines[0], *lines[-4:]]) + "\n")
    asked = ("season", RESULTS, str(last), "--ties", "head-to-head,difference")
    told = ask(*asked, "--sure")
    assert told["exact"]
    assert told["standard_error"] == 0.0
    assert told["seasons"] == 6**4
    assert not ask(*asked, "--seasons", "1000")["exact"]


def test_a_round_robin_needs_no_schedule(ask):
    asked = ("--seasons", "1000", "--sure", "--table-points", "sets")
    told = ask("season", RESULTS, "--meetings", "2", *asked)
    assert sum(row["played"] for row in told["teams"]) == 72


def test_one_file_may_have_the_whole_season(ask, tmp_path):
    season = tmp_path / "season.csv"
    played = (DATA / "demo_team_results.csv").read_text().splitlines()
    header, *to_come = (DATA / "demo_team_schedule.csv").read_text().splitlines()
    named = [dict(zip(header.split(","), line.split(","), strict=True)) for line in to_come]
    titles = played[0].split(",")
    for k, one in enumerate(named):
        score = ("", "0")[k % 2]
        cells = {"home_score": score, "away_score": score, **one}
        played.append(",".join(cells.get(title, "") for title in titles))
    season.write_text("\n".join(played) + "\n")
    asked = ("--seasons", "1000", "--sure", "--table-points", "sets")
    one, two = ask("season", str(season), *asked), ask("season", RESULTS, SCHEDULE, *asked)
    assert one["teams"] == two["teams"]


@pytest.mark.parametrize(("win", "whole"), [("2", True), ("1.5", False)])
def test_a_column_is_whole_or_not_as_a_whole(run, tmp_path, win, whole):
    path = tmp_path / "season.csv"
    rows = ["1,Chalk,Rack,3,2", "1,Cues,Break,4,1", "2,Chalk,Cues,,", "2,Rack,Cues,2,3"]
    path.write_text("\n".join(["round,home,away,home_score,away_score", *rows]) + "\n")
    asked = ("--up", "1", "--down", "1", "--seasons", "1000", "--table-points", f"{win},1,0")
    lines = run("season", str(path), *asked, "--csv").stdout.splitlines()
    rows = [line.split(",") for line in lines[1:]]
    assert sorted(row[1] for row in rows) == ["1", "1", "2", "2"]
    assert {"." in row[2] for row in rows} == {not whole}
    assert all("." in row[3] for row in rows)


def test_a_season_with_half_a_score_or_none_is_refused(run, tmp_path):
    bad = tmp_path / "bad.csv"
    bad.write_text("home,away,home_score,away_score\nA,B,3,2\nB,A,3,\n")
    assert "bad.csv:3: one score is empty" in run("season", str(bad)).stderr
    bad.write_text("home,away,home_score,away_score\nA,B,,\nB,A,0,0\n")
    assert "none of its matches has been played" in run("season", str(bad)).stderr


@pytest.mark.parametrize(
    ("words", "what"),
    [
        ([RESULTS], "--meetings"),
        ([RESULTS, "--meetings", "1"], "have met 2 times"),
        ([RESULTS, SCHEDULE, "--table-points", "1,2,3"], "A loss can't be worth more"),
        ([RESULTS, SCHEDULE, "--table-points", "2,1"], "2,1"),
        ([RESULTS, SCHEDULE, "--ties", "coin"], "coin"),
        ([RESULTS, SCHEDULE, "--up", "8"], "--up"),
        ([RESULTS, SCHEDULE, "--race", "3"], "--race 3"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(run, words, what):
    result = run("season", *words)
    assert result.exit_code in (1, 2, 3)
    assert what in result.stderr.splitlines()[-1]


def test_every_problem_of_a_file_is_named_at_once(run, tmp_path):
    bad = tmp_path / "bad.csv"
    bad.write_text("home,away,home_score,away_score\nA,A,3,2\nA,B,x,2\nA,,1,4\nB,A,0,0\nA,B,x,0\n")
    result = run("season", str(bad), "--meetings", "2")
    assert result.exit_code == 3
    for line in ("bad.csv:2", "bad.csv:3", "bad.csv:4"):
        assert line in result.stderr
    assert result.stderr.count("bad.csv:6") == 1


def test_teams_of_a_list_are_the_only_ones(run, tmp_path):
    teams = tmp_path / "teams.csv"
    teams.write_text("team,points\nKiss Shots,-2\nRack Pack,\n")
    result = run("season", RESULTS, SCHEDULE, "--teams", str(teams))
    assert result.exit_code == 3
    assert "'Cue Tips' isn't in the list of teams" in result.stderr


def test_what_may_have_been_entered_twice_is_named(run, tmp_path):
    results, schedule = tmp_path / "r.csv", tmp_path / "s.csv"
    results.write_text("home,away,home_score,away_score\nA,B,3,2\nB,A,3,2\nA,B,3,2\nC,D,1,4\n")
    schedule.write_text("round,home,away\n3,A,C\n3,B,D\n3,A,D\n4,A,C\n")
    said = run("season", str(results), str(schedule), "--sure", "--seasons", "1000").stderr
    assert "r.csv:4: A against B is already in line 2" in said
    assert "s.csv:4: A already plays in round 3, in line 2" in said
    assert "s.csv:4: D already plays in round 3, in line 3" in said
    assert said.count("already") == 3
