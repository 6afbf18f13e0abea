import json

import pytest

from places import DATA

DEMO = str(DATA / "demo_league.csv")


def test_the_ratings_and_the_race_are_those_of_the_report(run, tmp_path):
    names = ("Zoë Kestleman", "petra nowicz-hale")
    answer = json.loads(run("why", *names, "--from", DEMO, "--json").stdout)
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
        (("Ann", "Petra Nowicz-Hale", "--from", DEMO), 2, "'Ann'"),
        (("Zoë Kestleman", "zoë kestleman", "--from", DEMO), 2, "one player"),
        (("Zoë Kestleman", "Petra Nowicz-Hale"), 2, "--from"),
        (("Zoë Kestleman", "Petra Nowicz-Hale", "--from", "none.csv"), 3, "none.csv"),
    ],
)
def test_what_cannot_be_explained_is_refused(run, words, code, named):
    result = run("why", *words)
    assert result.exit_code == code
    assert named in result.stderr
