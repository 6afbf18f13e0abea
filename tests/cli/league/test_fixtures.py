"""Fixtures through the command line."""

import csv
import io

import pytest

from places import DATA
from rows import each_of

TEAMS = "team,venue,tables\nAcers,Corner,1\nBankers,Corner,\nCaroms,,\nDiamonds,Elm,\nEights,,\n"


@pytest.fixture
def teams(tmp_path):
    path = tmp_path / "teams.csv"
    path.write_text(TEAMS)
    return str(path)


def test_fixtures_go_round_to_season_and_back(ask, run, teams, tmp_path):
    made = run("league", "fixtures", teams, "--meetings", "2", "--begins", "2026-09-01", "--csv")
    rows = list(csv.DictReader(io.StringIO(made.stdout)))
    assert len(rows) == 20
    shared = [row["date"] for row in rows if row["venue"] == "Corner"]
    assert len(set(shared)) == len(shared) == 8
    schedule, results = tmp_path / "fixtures.csv", tmp_path / "results.csv"
    schedule.write_text(made.stdout)
    played = [rows[0], rows[3]]
    lines = [f"{row['home']},{row['away']},3,2" for row in played]
    results.write_text("\n".join(["home,away,home_score,away_score", *lines]) + "\n")
    left = ask("league", "fixtures", "--schedule", str(schedule), "--left", str(results))
    assert left["played"] == 2
    assert len(left["fixtures"]) == 18
    # The whole schedule as it was written says who meets whom to `season` without a warning.
    season = run("season", str(results), str(schedule), "--seasons", "1000")
    assert season.exit_code == 0
    assert "Warning" not in season.stderr


@pytest.mark.slow
def test_players_and_a_simulated_season(run, tmp_path):
    roster = str(DATA / "demo_roster.csv")
    made = run("league", "fixtures", roster, "--rounds-a-night", "2", "--tables", "4", "--csv")
    assert made.exit_code == 0, made.stderr
    schedule = tmp_path / "fixtures.csv"
    schedule.write_text(made.stdout)
    out = str(tmp_path / "out")
    words = ("simulate", roster, "--schedule", str(schedule), "--replicas", "2", "--out", out)
    done = run(*words, "--no-matches")
    assert done.exit_code == 0, done.stderr
    assert "not used" not in done.stderr


def test_one_teams_calendar(run, teams, tmp_path):
    path = tmp_path / "bankers.ics"
    words = ("league", "fixtures", teams, "--begins", "2026-09-01", "--time", "19:00")
    done = run(*words, "--only", "bankers", "--ics", str(path))
    assert done.exit_code == 0, done.stderr
    assert path.read_bytes().count(b"BEGIN:VEVENT") == 4
    drawn = [run(*words, "--draw", seed, "--csv").stdout for seed in ("1", "1", "2")]
    assert drawn[0] == drawn[1] != drawn[2]


@each_of(
    "words, message",
    [
        ((), "give LIST.csv, or use --schedule to name existing fixtures"),
        (("TEAMS", "--ends", "2026-09-08"), "--ends needs the first night"),
        (("TEAMS", "--ics", "f.ics"), "--ics needs dates"),
        (("TEAMS", "--begins", "2026-09-01", "--ends", "2026-09-08"), "5 nights are needed"),
        (("TEAMS", "--weekdays", "someday"), "Name days such as tue"),
        (("TEAMS", "--skip", "2026-12-24..2026-12-20"), "isn't a date range"),
        (("TEAMS", "--only", "Nobody"), "--only Nobody has no match"),
        (("TEAMS", "--of", "players"), "has no column player"),
    ],
)
def test_what_cannot_be_is_refused(words, message, run, teams):
    result = run("league", "fixtures", *[teams if word == "TEAMS" else word for word in words])
    assert result.exit_code in (2, 3)
    assert message in result.stderr
