"""Leagues with something odd about them, through every command that reads results or a list."""

import csv
import io
import json
import math

import pytest

HEADER = "date,player_a,player_b,score_a,score_b,forfeit"
LEAGUES = {
    "perfect records": ["Ann,Bo,5,0,", "Ann,Bo,5,0,", "Ann,Cy,5,0,", "Bo,Cy,5,0,"],
    "two groups that never met": ["Ann,Bo,5,3,", "Cy,Di,4,5,", "Ann,Bo,3,5,"],
    "one with forfeits only": ["Ann,Bo,5,3,", "Cy,Ann,0,5,yes", "Cy,Bo,,,yes"],
    "one with 0-0 only": ["Ann,Bo,5,3,", "Cy,Ann,0,0,"],
    "one match": ["Ann,Bo,5,3,"],
    "names of all kinds": [
        '"Lee, ""Ann""",=cmd(),5,3,',
        "דנה כהן,🎱 Émile,5,4,",
        '=cmd(),"Two\nLines",5,2,',
        "+1-555,'t Hooft,5,2,",
        '"Lee, ""Ann""",דנה כהן,5,3,',
    ],
}
leagues = pytest.mark.parametrize("rows", LEAGUES.values(), ids=LEAGUES)


@pytest.fixture
def league(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def written(rows):
        days = [f"2026-11-{day:02},{row}" for day, row in enumerate(rows, 1)]
        (tmp_path / "season.csv").write_text("\n".join([HEADER, *days]), encoding="utf-8")
        return "season.csv"

    return written


def rows_of(text):
    return list(csv.DictReader(io.StringIO(text)))


@leagues
def test_every_rating_is_finite_and_every_error_above_0(run, league, rows):
    result = run("rate", league(rows), "--json")
    assert result.exit_code == 0, result.stderr
    for player in json.loads(result.stdout)["players"]:
        assert math.isfinite(player["rating"])
        assert 0 < player["standard_error"] < 1000


@leagues
def test_the_list_of_rate_is_a_roster(run, league, tmp_path, rows):
    rated = run("rate", league(rows))
    (tmp_path / "list.csv").write_bytes(rated.stdout_bytes)
    result = run("matchups", "list.csv", "--games", "5..9")
    assert result.exit_code == 0, result.stderr
    players = len(rows_of(rated.stdout))
    assert len(rows_of(result.stdout)) == players * (players - 1) / 2


@pytest.mark.slow_after(1)
@leagues
def test_a_sheet_is_made(run, league, tmp_path, rows):
    result = run("report", league(rows), "--out", "sheet", "--html")
    assert result.exit_code == 0, result.stderr
    assert (tmp_path / "sheet" / "sheet.html").stat().st_size > 1000
    for line in (tmp_path / "sheet" / "ratings.csv").read_text("utf-8").splitlines():
        assert not line.startswith(("=", "+", "-", "@", '"='))


@leagues
def test_validate_answers_or_says_what_is_missing(run, league, rows):
    result = run("validate", league(rows), "--json")
    assert result.exit_code in (0, 3)
    assert (json.loads(result.stdout) if result.exit_code == 0 else result.stderr) != ""


@leagues
def test_a_night_moves_who_played(run, league, tmp_path, rows):
    rated = rows_of(run("rate", league(rows)).stdout)
    names = [row["player"] for row in rated]
    out = io.StringIO()
    csv.writer(out).writerows([["player", "rating"], *([name, 80] for name in names)])
    (tmp_path / "last.csv").write_text(out.getvalue(), encoding="utf-8")
    line = ("--system", "npl", "--roster", "last.csv", "--chart", "npl_10")
    result = run("rate", *line, "season.csv")
    assert result.exit_code == 0, result.stderr
    moves = [int(row["change"]) for row in rows_of(result.stdout)]
    assert sum(moves) == 0
    assert any(moves)


def test_the_ratings_of_a_perfect_record_stand_in_its_order(run, league):
    rated = rows_of(run("rate", league(LEAGUES["perfect records"])).stdout)
    assert [row["player"] for row in rated] == ["Ann", "Bo", "Cy"]


def test_players_of_two_groups_are_told_apart(run, league):
    result = run("rate", league(LEAGUES["two groups that never met"]))
    assert {row["player"]: row["component"] for row in rows_of(result.stdout)} == {
        "Ann": "1",
        "Bo": "1",
        "Cy": "2",
        "Di": "2",
    }
    assert "group" in result.stderr or "component" in result.stderr


def test_who_only_gave_matches_away_has_the_ratings_of_a_stranger(run, league):
    rated = rows_of(run("rate", league(LEAGUES["one with forfeits only"])).stdout)
    (cy,) = [row for row in rated if row["player"] == "Cy"]
    assert (cy["games"], float(cy["rating"])) == ("0", 80.0)
    assert float(cy["standard_error"]) == pytest.approx(30.0)


def test_a_season_of_forfeits_is_refused(run, league):
    path = league(["Ann,Bo,5,0,yes", "Cy,Ann,,,yes"])
    for words in (["rate", path], ["report", path, "--out", "sheet"], ["validate", path]):
        result = run(*words)
        assert (result.exit_code, result.stdout) == (3, "")
        assert "season.csv" in result.stderr


def test_two_players_of_one_name_on_a_list(run, league, tmp_path):
    (tmp_path / "last.csv").write_text("player,rating\nBob,80\nAnn,92\n Bob ,70\n")
    night = league(["Ann,Bob,5,3,"])
    for words in (
        ["rate", "--system", "npl", "--roster", "last.csv", night],
        ["matchups", "last.csv", "--games", "5..9"],
    ):
        result = run(*words)
        assert result.exit_code == 3
        assert "last.csv:4: player 'Bob'" in result.stderr


@pytest.mark.parametrize("words", [["rate"], ["report", "--out", "sheet"], ["validate"]])
def test_aliases_are_read_by_each_command_that_reads_results(run, league, tmp_path, words):
    rows = ["Ann,Bo,5,3,", "Annie,Bo,5,4,", "Bo,Cy,5,2,", "Cy,Annie,5,1,", "Ann,Cy,5,4,"]
    (tmp_path / "aliases.csv").write_text("name,means\nAnnie,Ann\n")
    result = run(*words, league(rows), "--aliases", "aliases.csv")
    assert result.exit_code == 0, result.stderr
    assert "'Annie' as 'Ann'" in result.stderr
    assert "Annie" not in result.stdout
    refused = run(*words, "season.csv", "--aliases", "season.csv")
    assert refused.exit_code == 3
    assert "season.csv:1: there are no columns 'name'" in refused.stderr
