"""Form of the day from `rate` on: stated in its list, and allowed for by what reads it."""

import csv
import io
import json
from pathlib import Path

import pytest

from evenbreak.games import Race, Rack
from evenbreak.matches import match_odds
from places import DATA

LEAGUE = str(DATA / "demo_league.csv")
PAIR = ("Ines Valbrecht", "Marguerite Oduya")
NO_FORM = ("--form", "0")


@pytest.fixture
def ask(run):
    def answer(*words):
        result = run(*words, "--json")
        assert result.exit_code == 0, result.stderr
        return json.loads(result.stdout)

    return answer


@pytest.fixture
def ratings(run, tmp_path):
    result = run("rate", LEAGUE, "--prior", "30")
    path = tmp_path / "ratings.csv"
    path.write_text(result.stdout, encoding="utf-8")
    return str(path)


def test_rate_states_what_is_established(ask, ratings):
    form = ask("rate", LEAGUE, "--prior", "30")["form"]
    rows = list(csv.DictReader(io.StringIO(Path(ratings).read_text(encoding="utf-8"))))
    assert form["established"]
    assert {float(row["match_form"]) for row in rows} == {round(form["sd"], 4)}
    doubtful = ask("rate", str(DATA / "demo_sandbag.csv"), "--prior", "12")
    assert not doubtful["form"]["established"]
    assert "match_form" not in doubtful["players"][0]


def test_odds_fair_and_live_take_form_from_the_list(ask, ratings):
    who = (*PAIR, "--from", ratings)
    for words in (("odds", "--race", "7:6"), ("fair", "--race-to", "7"), ("live", "--race", "7:6")):
        listed, typed = ask(words[0], *who, *words[1:]), ask(words[0], *who, *words[1:], *NO_FORM)
        assert listed["form"] > 0.4
        assert "form" not in typed
        assert json.dumps(listed) != json.dumps(typed)
    odds, plain = (ask("odds", *who, "--race", "7:6", *more) for more in ((), NO_FORM))
    assert odds["p_game_a"] == plain["p_game_a"]
    assert odds["p_hill_hill"] < plain["p_hill_hill"]


def test_matchups_take_form_from_the_list(ask, ratings, tmp_path):
    pairs = tmp_path / "pairs.csv"
    pairs.write_text(f"player_a,player_b\n{PAIR[0]},{PAIR[1]}\n", encoding="utf-8")
    asked = ("matchups", ratings, "--race-to", "7", "--pairs", str(pairs))
    asked += ("--discipline", "9-ball", "--tables", "1")
    listed, plain = ask(*asked), ask(*asked, *NO_FORM)
    assert (listed["form"] > 0.4, plain["form"]) == (True, 0.0)
    (end,), (other,) = listed["evening"], plain["evening"]
    assert end["mean_minutes"] < other["mean_minutes"]
    (pair,) = listed["pairs"]
    odds = ask("odds", *PAIR, "--from", ratings, "--race", f"{pair['race_a']}:{pair['race_b']}")
    assert pair["p_win_a"] == pytest.approx(odds["p_win_a"], abs=1e-9)
    assert pair["mean_games"] == pytest.approx(odds["mean_games"], abs=1e-9)


def test_a_report_has_the_races_of_its_list(run, ask, tmp_path):
    sheet = tmp_path / "sheet"
    result = run("report", LEAGUE, "--prior", "30", "--top", "2", "--out", str(sheet), "--json")
    told = json.loads(result.stdout)
    assert float(told["summary"]["match_form_log_odds"]) > 0.4
    (row,) = told["matchups"]
    who = row["player_a"], row["player_b"]
    again = ask("fair", *who, "--from", str(sheet / "ratings.csv"), "--race-to", "7", "--top", "1")
    (race,) = again["races"]
    assert (race["race_a"], race["race_b"]) == (row["race_a"], row["race_b"])
    assert race["p_win_a"] == pytest.approx(row["p_win_a"], abs=1e-9)


def test_form_by_hand(ask):
    odds = ask("odds", "--p", "0.6", "--race", "9:9", "--form", "0.35")
    assert odds["p_win_a"] == match_odds(Race(9, 9, Rack(0.6)), form=0.35).p_win_1
    fair = ask("fair", "--p", "0.6", "--race-to", "7", "--form", "0.35")
    best = fair["races"][0]
    odds = ask(
        "odds", "--p", "0.6", "--race", f"{best['race_a']}:{best['race_b']}", "--form", "0.35"
    )
    assert best["p_win_a"] == pytest.approx(odds["p_win_a"], abs=1e-9)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("odds --p 0.6 --race 5 --form 4", "'4'"),
        ("odds --p 0.6 --race 5 --form 0.3 --exact", "--exact"),
        ("odds --p 0.6 --race 5 --form 0.3 --via eigen", "--via"),
        ("odds --p1 .6 --p2 .5 --breaks winner --race 5 --score 1:0 --form 0.3", "--score"),
        ("fair --p1 .6 --p2 .5 --breaks winner --race-to 5 --form 0.3", "--form"),
        ("fair --p 1 --race-to 5 --form 0.3", "--form"),
        ("live --p 0.6 --ahead 3 --form 0.3", "--form"),
    ],
)
def test_what_is_refused(run, words, said):
    result = run(*words.split())
    assert result.exit_code == 2
    assert said in result.stderr


def test_a_list_with_two_forms_is_refused(run, tmp_path):
    path = tmp_path / "club.csv"
    path.write_text("player,rating,match_form\nAnn,90,0.3\nBo,80,0.4\nCy,70,5\n", encoding="utf-8")
    result = run("matchups", str(path), "--race-to", "7")
    assert result.exit_code == 3
    assert f"{path}:3: match_form 0.4" in result.stderr
    assert f"{path}:4" in result.stderr
