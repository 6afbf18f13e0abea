"""`evenbreak sandbag watch`: who is flagged, and what it rests on."""

import csv
import json
from pathlib import Path

import pytest

from places import DATA

SEASON = (str(DATA / "demo_sandbag.csv"), "--roster", str(DATA / "demo_sandbag_roster.csv"))
LEAGUE = ("--dumps-in", "League night")


@pytest.fixture
def watch(run):
    def ask(*words):
        result = run("sandbag", "watch", *SEASON, *words)
        assert result.exit_code == 0, result.stderr
        return result.stdout

    return ask


def table(text):
    return list(csv.DictReader(text.splitlines()))


def test_into_a_pipe_goes_a_row_for_each_player(watch):
    rows = table(watch(*LEAGUE))
    assert len(rows) == 10
    (flagged,) = [row for row in rows if row["flagged"] == "yes"]
    assert flagged["player"] == "Vito Drago"
    assert flagged["alarm_match"].isdigit()
    assert flagged["alarm_date"].startswith("2025-")
    assert float(flagged["p_value"]) == pytest.approx(1 / float(flagged["largest_e"]), abs=1e-6)


@pytest.mark.slow
def test_json_and_the_picture(watch, tmp_path):
    path = tmp_path / "watch.png"
    answer = json.loads(watch("--json", "--plot", str(path)))
    assert (answer["alpha"], answer["honest"], len(answer["players"])) == (0.01, "any", 10)
    assert [row["event"] for row in answer["players"] if row["flagged"]] == ["League night"]
    assert path.read_bytes().startswith(b"\x89PNG")


@pytest.mark.slow
def test_the_cheater_of_the_demo_league_is_flagged_without_naming_the_event(watch):
    answer = json.loads(watch("--json"))
    assert sorted(answer["tried_events"]) == ["Cup", "League night"]
    (flagged,) = [row for row in answer["players"] if row["flagged"]]
    assert (flagged["player"], flagged["event"]) == ("Vito Drago", "League night")
    (named,) = [row for row in json.loads(watch("--json", *LEAGUE))["players"] if row["flagged"]]
    assert named["e_value"] / 3 < flagged["e_value"] < named["e_value"]
    assert json.loads(watch("--json", "--player", "Vito Drago"))["event"] == "League night"
    assert "League night" in watch("--text")


@pytest.mark.slow
def test_what_each_match_of_a_player_weighs(watch):
    one = json.loads(watch("--json", "--player", "Gus Lindahl"))
    assert (one["player"], len(one["matches"])) == ("Gus Lindahl", 52)
    rows = table(watch("--player", "Gus Lindahl"))
    assert {row["won"] for row in rows} == {"yes", ""}


@pytest.mark.slow
def test_varying_form_weakens_the_evidence(watch, run):
    plain = {row["player"]: row for row in table(watch(*LEAGUE))}
    varied = {row["player"]: row for row in table(watch(*LEAGUE, "--day-sd", "30"))}
    assert float(varied["Vito Drago"]["e_any"]) < float(plain["Vito Drago"]["e_any"]) / 10.0
    refused = run("sandbag", "watch", *SEASON, "--day-sd", "500")
    assert refused.exit_code == 2
    assert (
        "Error: --day-sd must be 0 to 120 points (4 doublings of the odds); you gave 500"
    ) in refused.stderr


def test_a_roster_of_mixed_scales_is_refused_or_a_warning(run, tmp_path):
    roster = tmp_path / "mixed.csv"
    header, *rows = Path(SEASON[2]).read_text(encoding="utf-8").splitlines()
    place = header.split(",").index("rating")
    for number, row in enumerate(rows[:3]):
        cells = row.split(",")
        cells[place] = "570"
        rows[number] = ",".join(cells)
    roster.write_text("\n".join([header, *rows]) + "\n", encoding="utf-8")
    asked = ("sandbag", "watch", SEASON[0], "--roster", str(roster), "--json")
    assert "570 don't show which scale they're on" in run(*asked).stderr
    result = run(*asked, "--scale", "npl")
    (warning,) = json.loads(result.stdout)["warnings"]
    assert f"3 of {len(rows)} ratings" in warning


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("-", "--roster", "-"), "only one file"),
        (("x.csv",), "'--roster'"),
        ((*SEASON, "--player", "Nobody"), "'Nobody'"),
        ((*SEASON, "--alpha", "1"), "'1'"),
        ((*SEASON, "--dumps-in", "league"), "Cup, League night"),
    ],
)
def test_what_is_wrong_is_refused_by_name(run, words, named):
    result = run("sandbag", "watch", *words)
    assert (result.exit_code, result.stdout) == (2, "")
    assert named in result.stderr


@pytest.fixture
def plain(tmp_path):
    """A season without races, between players of whom nobody has a rating of their own."""
    season, roster = tmp_path / "season.csv", tmp_path / "roster.csv"
    days = [(f"2025-09-{day:02d}", "Bo" if day % 2 else "Cy", day % 4) for day in range(1, 29)]
    rows = [f"{date},Ann,{other},7,{lost}" for date, other, lost in days]
    season.write_text("\n".join(["date,player_a,player_b,score_a,score_b", *rows]))
    roster.write_text("player,rating\nAnn,80\nBo,80\nCy,80\n")
    return str(season), "--roster", str(roster)


def test_races_that_are_not_stated_are_even(run, plain):
    result = run("sandbag", "watch", *plain, "--player", "Ann", "--json")
    assert result.exit_code == 0, result.stderr
    assert "28 matches" in result.stderr
    matches = json.loads(result.stdout)["matches"]
    assert {(row["needs"], row["opponent_needs"]) for row in matches} == {(7, 7)}


@pytest.mark.slow
def test_established_is_doubted_where_players_have_no_ratings_of_their_own(run, plain):
    assert "3 of 3 players" in run("sandbag", "watch", *plain, "--honest", "established").stderr
    assert "3 of 3 players" not in run("sandbag", "watch", *plain).stderr
    assert "established" not in run("sandbag", "watch", *SEASON, "--honest", "established").stderr


@pytest.mark.slow
def test_a_player_is_found_in_any_case_and_spacing(watch, run):
    asked = json.loads(watch("--json", "--player", " gus  LINDAHL "))
    assert asked["player"] == "Gus Lindahl"
    result = run("sandbag", "watch", *SEASON, "--player", "Gus Lindhal")
    assert result.exit_code == 2
    assert "did you mean 'Gus Lindahl'" in result.stderr
