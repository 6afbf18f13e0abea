import json

import pytest

from places import DATA

DEMO = str(DATA / "demo_league.csv")


@pytest.mark.slow
def test_the_ratings_and_the_race_are_those_of_the_report(run, tmp_path):
    names = ("Zoë Kestleman", "petra nowicz-hale")
    answer = json.loads(run("why", *names, "--results", DEMO, "--json").stdout)
    words = ("--players", ",".join(names), "--json", "--out", str(tmp_path))
    sheet = json.loads(run("report", DEMO, *words).stdout)
    (pair,) = sheet["matchups"]
    for name in ("player_a", "player_b", "race_a", "race_b"):
        assert answer[name] == pair[name]
    assert answer["p_win_a"] == pytest.approx(pair["p_win_a"])
    assert len(answer["matches"]) == 31 + 34


@pytest.mark.parametrize(
    ("words", "code", "named"),
    [
        (("Ann", "Petra Nowicz-Hale", "--results", DEMO), 2, "'Ann'"),
        (("Zoë Kestleman", "zoë kestleman", "--results", DEMO), 2, "are the same player"),
        (("Zoë Kestleman", "Petra Nowicz-Hale"), 2, "--results"),
        (("Zoë Kestleman", "Petra Nowicz-Hale", "--results", "none.csv"), 3, "none.csv"),
    ],
)
def test_what_cannot_be_explained_is_refused(run, words, code, named):
    result = run("why", *words)
    assert result.exit_code == code
    assert named in result.stderr


SEASON = """date,player_a,player_b,score_a,score_b,forfeit
2026-01-01,Ann,Bo,7,5,
2026-01-08,Bo,Cy,7,2,
2026-01-15,Ann,Cy,6,6,
,Ann,Bo,,,yes
"""


def test_forfeits_without_a_date_do_not_matter_to_a_half_life(run, tmp_path):
    path = tmp_path / "season.csv"
    path.write_text(SEASON)
    words = ("why", "Ann", "Bo", "--results", str(path), "--half-life", "30", "--json")
    answer = json.loads(run(*words).stdout)
    assert len(answer["one_more"]) == 2
    path.write_text(SEASON.rpartition(",Ann")[0])
    assert json.loads(run(*words).stdout)["matches"] == answer["matches"]
    assert [one["result"] for one in answer["matches"]] == ["won", "level", "lost", "won"]


def test_the_doubts_of_a_report_are_shown(run, tmp_path):
    path = tmp_path / "season.csv"
    path.write_text(SEASON.rpartition(",Ann")[0])
    answer = json.loads(
        run("why", "Ann", "Bo", "--results", str(path), "--prior", "best", "--json").stdout
    )
    assert any("6-6" in warning for warning in answer["warnings"])
    assert any("prior" in warning for warning in answer["warnings"])
