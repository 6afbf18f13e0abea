"""The rules of a team league through the command line."""

import pytest

from places import DATA

TEAMS = str(DATA / "demo_team_rosters.csv")


@pytest.mark.slow
def test_a_cap_takes_from_the_strong_and_chances_average_to_one_half(ask):
    told = ask("caps", TEAMS, "--race", "5", "--sets", "3", "--cap", "14")
    rows = {row["team"]: row for row in told["teams"]}
    assert len(rows) == 6
    for key in ("p_win", "p_win_free"):
        assert sum(row[key] for row in rows.values()) == pytest.approx(3.0)
    assert rows["Eight Ballers"]["cap_worth"] < 0 < rows["Late Shift"]["cap_worth"]


@pytest.mark.parametrize(
    ("lines", "words", "code", "what"),
    [
        (None, [], 2, "--race, --race-to and --chart"),
        (None, ["--race", "5", "--cap", "5"], 2, "Eight Ballers: no lineup of Ada"),
        (None, ["--race", "5", "--order", "XY"], 2, "XY"),
        ("team,player,rating\nA,Ann,600\nA,Bo,500\n", ["--race", "5"], 3, "only one team"),
        ("team,player,rating\nA,Ann,600\n,Bo,500\n", ["--race", "5"], 3, ":3: team is empty"),
        ("team,player,rating\nA,Ann,x\nB,Bo,500\n", ["--race", "5"], 3, ":2:"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(run, tmp_path, lines, words, code, what):
    file = TEAMS
    if lines is not None:
        (tmp_path / "teams.csv").write_text(lines)
        file = str(tmp_path / "teams.csv")
    result = run("caps", file, *words)
    assert result.exit_code == code
    assert what in result.stderr.splitlines()[-1]
