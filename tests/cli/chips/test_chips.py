"""`evenbreak chips`: odds of chip tournaments, audits and designs of chip charts."""

import json

import pytest

ENTRANTS = "player,rating,scale\nAnn,650,fargo\nBo,500,fargo\nCy,450,fargo\nDi,350,fargo\n"


@pytest.fixture
def chips(run, tmp_path):
    (tmp_path / "entrants.csv").write_text(ENTRANTS)

    def ask(*words):
        words = [str(tmp_path / word) if word.endswith(".csv") else word for word in words]
        return run("chips", *words)

    return ask


def read(result):
    assert result.exit_code == 0, result.stderr
    return json.loads(result.stdout)


def test_the_last_two_have_the_published_chances(chips):
    audited = read(chips("audit", "hoboken", "--json"))
    found = {(row["stronger"], row["weaker"]): row["p_stronger"] for row in audited["heads_up"]}
    assert found[650, 350] == pytest.approx(0.9736, abs=5e-5)
    assert found[550, 450] == pytest.approx(0.7110, abs=5e-5)
    assert found[450, 350] == pytest.approx(0.8505, abs=5e-5)
    left = read(chips("odds", "entrants.csv", "--left", "Ann=4,Bo=6", "--json"))
    assert left["exact"]
    assert left["players"][0]["p_title"] == pytest.approx(0.8127, abs=5e-5)


def test_odds_from_the_start_and_with_three_left(chips):
    whole = read(chips("odds", "entrants.csv", "--chips", "pharaohs", "--tables", "1", "--json"))
    assert not whole["exact"]
    assert [row["chips"] for row in whole["players"] if row["name"] == "Di"] == [7]
    assert sum(row["p_title"] for row in whole["players"]) == pytest.approx(1.0)
    three = read(chips("odds", "entrants.csv", "--left", "Di=2,Ann=1,Cy=3", "--json"))
    assert three["exact"]
    assert sum(row["p_third"] for row in three["players"]) == pytest.approx(1.0)


def test_a_designed_chart_is_fairer_and_can_be_read(chips, tmp_path):
    designed = chips("design", "entrants.csv", "--bands", "400,480,600", "--csv")
    (tmp_path / "ours.csv").write_text(designed.stdout)
    ours, hoboken = (
        read(chips("audit", name, "--entrants", "entrants.csv", "--json"))
        for name in ("ours.csv", "hoboken")
    )
    assert ours["spread"] < 0.5 * hoboken["spread"]
    assert hoboken["rows"][0]["times_equal_share"] > 2.0


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("odds", "entrants.csv"), "--chips"),
        (("odds", "entrants.csv", "--chips", "moon"), "moon"),
        (("odds", "entrants.csv", "--left", "Ann=0,Bo=1"), "Ann=0"),
        (("odds", "entrants.csv", "--left", "Ann=1,Ann=2"), "Ann"),
        (("odds", "entrants.csv", "--left", "Ann=1,Zoe=2"), "Zoe"),
        (("design", "--fewest", "5", "--most", "4"), "--fewest"),
        (("design", "--bands", "low"), "--bands"),
    ],
)
def test_wrong_options_are_refused(chips, words, named):
    result = chips(*words)
    assert result.exit_code == 2
    assert named in result.stderr


@pytest.mark.parametrize(
    ("listed", "named"),
    [
        ("rating_from,chips\n,5\n400,6\n", "players rated 400 or above get 6"),
        ("rating_from,chips\n400,6\n400,5\n", "row from 400"),
        ("rating_from,chips\n,5\n400,none\n", "ours.csv:3"),
        ("rating_from\n400\n", "chips"),
    ],
)
def test_wrong_charts_are_refused(chips, tmp_path, listed, named):
    (tmp_path / "ours.csv").write_text(listed)
    result = chips("audit", "ours.csv")
    assert result.exit_code == 3
    assert named in result.stderr
