"""A league's table through the command line."""

import pytest

from places import DATA
from rows import each_of

TEAMS = str(DATA / "demo_team_results.csv")
SETS = """date,team_a,team_b,player_a,player_b,score_a,score_b,race_a,race_b,forfeit,winner
2026-09-01,Acers,Bankers,Al,Xi,5,0,5,3,,
2026-09-01,Acers,Bankers,Bea,Yu,2,2,2,4,,
2026-09-01,Acers,Bankers,Cas,Zed,4,2,4,3,,
2026-09-01,Acers,Bankers,Dee,Ugo,1,3,5,3,,
2026-09-08,Bankers,Caroms,Xi,Joe,3,1,3,2,,
2026-09-08,Bankers,Caroms,Yu,Kim,4,1,4,2,,
2026-09-08,Bankers,Caroms,Zed,Lou,,,,,yes,a
2026-09-15,Caroms,Acers,Joe,Al,,,,,,
"""


@pytest.fixture
def sets(tmp_path):
    path = tmp_path / "sets.csv"
    path.write_text(SETS)
    return str(path)


def test_the_table_of_teams_is_that_of_season(ask):
    rows = ask("league", "table", TEAMS, "--of", "teams")["table"]
    season = ask("season", TEAMS, "--meetings", "2", "--seasons", "1000", "--sure")["teams"]
    assert {(row["team"], row["points"], row["played"]) for row in rows} == {
        (row["team"], row["points"], row["played"]) for row in season
    }


def test_apa_points_by_set_and_what_stood_before(ask, sets):
    told = ask("league", "table", sets, "--table-points", "apa_8ball")
    rows = [
        (row["place"], row["team"], row["points"], row["place_before"]) for row in told["table"]
    ]
    assert rows == [(1, "Bankers", 9, 2), (2, "Acers", 7, 1), (3, "Caroms", 2, 3)]
    assert told["rules"]["split"] == "apa_8ball"
    before = ask("league", "table", sets, "--table-points", "apa_8ball", "--until", "2026-09-07")
    assert [row["team"] for row in before["table"]] == ["Acers", "Bankers", "Caroms"]


def test_players_deductions_and_sides(ask, sets, tmp_path):
    listed = tmp_path / "list.csv"
    listed.write_text("name,points\nXI,-3\nNobody,\n")
    rows = ask("league", "table", sets, "--of", "players", "--teams", str(listed))["table"]
    by_name = {row["player"]: row for row in rows}
    assert by_name["XI"]["points"] == -1
    assert by_name["Nobody"]["played"] == 0
    assert by_name["Lou"]["forfeits"] == 1
    home = ask("league", "table", sets, "--side", "home")["table"]
    assert {row["team"]: row["played"] for row in home} == {"Acers": 1, "Bankers": 1, "Caroms": 0}


def test_a_league_of_skill_levels_needs_its_file_alone(ask, tmp_path, monkeypatch):
    head = "date,team_a,team_b,player_a,player_b,score_a,score_b,level_a,level_b\n"
    own = tmp_path / "autumn.csv"
    toml = 'chart = "{0}"\n[standings]\npoints = "{0}"\n[[results]]\nfile = "autumn.csv"\n'
    monkeypatch.chdir(tmp_path)
    for chart, rows, points in (
        ("apa_8ball", "Al,Xi,2,5,4,6\nBea,Yu,2,0,3,3", [4, 2]),
        ("apa_9ball", "Al,Xi,25,21,3,3\nBea,Yu,37,46,5,6\nCy,Zed,75,17,9,9", [41, 19]),
    ):
        lines = [f"2026-09-01,Acers,Bankers,{row}" for row in rows.split("\n")]
        own.write_text(head + "\n".join(lines) + "\n")
        (tmp_path / "league.toml").write_text(toml.format(chart))
        assert [row["points"] for row in ask("league", "table")["table"]] == points


@each_of(
    "words, message",
    [
        ((TEAMS, "--table-points", "apa_8ball"), "36 of 36 matches have no race"),
        (
            (TEAMS, "--ties", "lots"),
            (
                "Error: Invalid value for '--ties': ties must be 'difference', 'scored', "
                "'wins', 'head-to-head', 'win-share', 'forfeits' or 'points'; you gave 'lots'"
            ),
        ),
        ((TEAMS, "--table-points", "3"), "or sets, or apa_8ball"),
        (("--table-points", "0,1,2", TEAMS), "A loss can't be worth more"),
    ],
)
def test_what_cannot_be_is_refused(words, message, run):
    result = run("league", "table", *words)
    assert result.exit_code == 2
    assert message in result.stderr


def test_a_file_without_a_row_is_refused(run, tmp_path):
    (tmp_path / "r.csv").write_text("player_a,player_b,score_a,score_b\n")
    done = run("league", "table", str(tmp_path / "r.csv"))
    assert done.exit_code == 3
    assert "has no matches below its header" in done.stderr
