"""`evenbreak rate`, asked as a league operator asks it."""

import csv
import io
import json
import math

import pytest

from places import DATA

SEASON = """\
date,player_a,player_b,score_a,score_b,break_format
2026-01-05,Ann Lee,Bo Diaz,7,5,a
2026-01-12,Bo Diaz,Cy,7,4,b
2026-01-19,Cy,Ann Lee,3,7,a
2026-02-02,Ann Lee,Cy,7,2,b
"""
COLUMNS = [
    "player",
    "rating",
    "standard_error",
    "quasi_error",
    "games",
    "won",
    "lost",
    "races_won",
    "races_lost",
    "component",
    "provisional",
    "scale",
]


@pytest.fixture
def rate(run, tmp_path):
    """Rate a season, given as text; return the result."""

    def ask(*words, season=SEASON):
        path = tmp_path / "season.csv"
        path.write_text(season, encoding="utf-8")
        return run("rate", str(path), *words)

    return ask


@pytest.fixture
def told(rate):
    def ask(*words, season=SEASON):
        result = rate("--json", *words, season=season)
        assert result.exit_code == 0, result.stderr
        return json.loads(result.stdout)

    return ask


def ratings_of(answer):
    return {player["player"]: player["rating"] for player in answer["players"]}


def test_csv_into_a_pipe_and_words_beside_it(rate):
    result = rate("--scale", "fargo")
    rows = list(csv.DictReader(io.StringIO(result.stdout)))
    assert list(rows[0]) == COLUMNS
    assert [row["player"] for row in rows] == ["Ann Lee", "Bo Diaz", "Cy"]
    assert sum(float(row["rating"]) for row in rows) == pytest.approx(1500, abs=1e-5)
    assert "3 players, 4 matches, 42 games" in result.stderr
    assert "100 points double the odds" in result.stderr


def test_the_same_as_the_library(told):
    from evenbreak.ratings import Results, fit

    season = Results.from_names(
        ["Ann Lee", "Bo Diaz", "Cy", "Ann Lee"],
        ["Bo Diaz", "Cy", "Ann Lee", "Cy"],
        [7, 7, 3, 7],
        [5, 4, 7, 2],
        date=["2026-01-05", "2026-01-12", "2026-01-19", "2026-02-02"],
        break_format=[4, 5, 4, 5],
    )
    answer = told("--prior=15", "--half-life=10", "--as-of=2026-01-20", "--break-advantage=fit")
    ratings = fit(
        season,
        prior_sd=math.log(2) / 2,
        half_life=10,
        as_of="2026-01-20",
        break_advantage="fit",
    )
    got = ratings_of(answer)
    for name, rating in zip(ratings.players, ratings.rating, strict=True):
        assert got[name] == pytest.approx(rating)
    assert answer["later_left_out"] == 1
    assert answer["break_advantage"] == pytest.approx(ratings.break_advantage)
    assert answer["break_advantage_standard_error"] == pytest.approx(ratings.break_error)
    assert (answer["half_life_days"], answer["as_of"]) == (10, "2026-01-20")
    assert answer["prior_sd_points"] == pytest.approx(15)


def test_anchors(told):
    assert sum(ratings_of(told("--anchor=50")).values()) == pytest.approx(150)
    named = told("--anchor", "ann lee=100", "--anchor", "Cy = 60")
    got = ratings_of(named)
    assert got["Ann Lee"] + got["Cy"] == pytest.approx(160)
    assert named["anchored_at"] == {"Ann Lee": 100, "Cy": 60}


def test_pairs(rate, told):
    (pair,) = told("--pair", "cy", "Ann Lee")["pairs"]
    assert (pair["player_a"], pair["player_b"]) == ("Cy", "Ann Lee")
    got = ratings_of(told())
    assert pair["difference"] == pytest.approx(got["Cy"] - got["Ann Lee"])
    assert pair["p_game_a"] == pytest.approx(1 / (1 + 2 ** (-pair["difference"] / 30)))
    line = rate("--pair", "Cy", "Ann Lee").stdout.splitlines()[0]
    assert line == "player_a,player_b,difference,standard_error,p_game_a,note"


def test_pairs_that_nothing_links_have_no_numbers(told):
    season = "player_a,player_b,score_a,score_b\nAnn,Bo,7,5\nCy,Di,7,5\n"
    (pair,) = told("--pair", "Ann", "Cy", season=season)["pairs"]
    assert (pair["difference"], pair["p_game_a"]) == (None, None)
    assert "no chain of opponents" in pair["note"]


@pytest.mark.slow
def test_the_best_prior_is_among_those_tried(told):
    answer = told("--prior", "best", season=(DATA / "demo_league.csv").read_text(encoding="utf-8"))
    best = min(answer["priors_tried"], key=lambda tried: tried["log_loss"])
    assert answer["prior_sd_points"] == pytest.approx(best["prior_sd_points"])
    assert answer["prior_learned"] is True
    plain = told()
    assert (plain["priors_tried"], plain["prior_learned"]) == (None, None)


def test_a_few_matches_are_warned_of_and_leave_the_default_prior(rate):
    result = rate("--json", "--prior", "best")
    answer = json.loads(result.stdout)
    assert answer["prior_learned"] is False
    assert answer["prior_sd_points"] == pytest.approx(30)
    assert "aren't enough" in result.stderr


def test_groups_that_never_met_are_kept_apart(rate):
    season = "player_a,player_b,score_a,score_b\nAnn,Bo,5,7\nBo,Cy,5,7\nDi,Eve,9,0\nFi,Ann,0,0\n"
    result = rate(season=season)
    rows = list(csv.DictReader(io.StringIO(result.stdout)))
    assert [row["component"] for row in rows] == ["1", "1", "1", "2", "2", "3"]
    assert "2 groups of players (3 and 2)" in result.stderr
    assert "1 player has no games that count" in result.stderr


def test_winners_alone(rate):
    season = "player_a,player_b,race_a,race_b,winner\nAnn,Bo,7,5,Ann\nBo,Cy,5,5,b\n"
    result = rate(season=season)
    rows = {row["player"]: row for row in csv.DictReader(io.StringIO(result.stdout))}
    assert (rows["Ann"]["races_won"], rows["Ann"]["games"]) == ("1", "0")
    assert float(rows["Ann"]["rating"]) > float(rows["Bo"]["rating"])
    assert "2 matches with only the winner known" in result.stderr


@pytest.mark.parametrize("advantage", ["fit", "5"])
def test_a_break_advantage_without_known_breaks_is_a_warning(rate, advantage):
    season = "player_a,player_b,score_a,score_b\nAnn,Bo,7,5\n"
    result = rate("--break-advantage", advantage, season=season)
    assert result.exit_code == 0
    assert "Warning:" in result.stderr
    assert "--break-advantage changes nothing" in result.stderr


def test_names_cannot_become_formulas(rate):
    season = 'player_a,player_b,score_a,score_b\n=cmd(),"Lee, Ann",7,5\n'
    rows = list(csv.reader(io.StringIO(rate(season=season).stdout)))
    assert {row[0] for row in rows[1:]} == {"'=cmd()", "Lee, Ann"}


@pytest.mark.parametrize(
    ("words", "code", "remedy"),
    [
        (["--prior", "0"], 2, "on this scale give"),
        (["--prior", "wide"], 2, "a number of points, or best"),
        (["--prior", "1e6"], 2, "on this scale give"),
        (["--half-life", "-3"], 2, "a number of days"),
        (["--as-of", "3/1/2026"], 2, "--dates mdy or --dates dmy"),
        (["--as-of", "soon"], 2, "such as 2026-01-31"),
        (["--as-of", "2204-04-01"], 2, "--as-of must be no more than a year from today"),
        (["--as-of", "2020-01-01"], 3, "2020-01-01. Give a later day"),
        (["--break-advantage", "nan"], 2, "a number of points, or fit"),
        (["--anchor", "high"], 2, "such as 80, or NAME=POINTS"),
        (["--anchor", "1", "--anchor", "2"], 2, "not both"),
        (["--anchor", "1", "--anchor", "Cy=2"], 2, "not both"),
        (["--anchor", "Cyy=2"], 2, "'Cyy' (did you mean 'Cy'"),
        (["--pair", "Cy", "Cy"], 2, "'Cy'. Name two"),
        (["--pair", "Cy", "An"], 2, "'An' (did you mean"),
        (["--roster", "last.csv"], 2, "Give --system npl too"),
        (["--system", "npl"], 2, "Give --roster LAST.csv"),
        (["--system", "npl", "--roster", "x", "--prior", "best"], 2, "Leave out --prior"),
        (
            ["--system", "npl", "--roster", "x", "--break-advantage", "0"],
            2,
            "Leave out --break-advantage",
        ),
        (["--scale", "0"], 2, "points that double the odds"),
    ],
)
def test_wrong_use_says_how_to_correct_it(rate, words, code, remedy):
    result = rate(*words)
    assert (result.exit_code, result.stdout) == (code, "")
    assert remedy in result.stderr
    assert "Traceback" not in result.stderr


def test_a_day_may_be_written_as_in_results_files(rate):
    by_dots, by_dashes = (rate("--as-of", day).stdout for day in ("20.1.2026", "2026-01-20"))
    assert by_dots == by_dashes != rate().stdout


def test_dates_are_needed_for_what_goes_by_dates(rate):
    season = "player_a,player_b,score_a,score_b\nAnn,Bo,7,5\nAnn,Bo,7,5\n"
    for words in (["--prior", "best"], ["--half-life", "9"], ["--as-of", "2026-01-01"]):
        result = rate(*words, season=season)
        assert (result.exit_code, result.stdout) == (2, "")
        assert "2 of 2 matches have no date" in result.stderr


@pytest.mark.slow
def test_the_break_advantage_of_the_demo_league_is_recovered(run):
    """Its script lets the breaker play 8 points better, and keeps scores and first breaks only."""
    demo = DATA / "demo_league.csv"
    answer = json.loads(run("rate", str(demo), "--break-advantage", "fit", "--json").stdout)
    error = answer["break_advantage_standard_error"]
    assert 2 < error < 5
    assert abs(answer["break_advantage"] - 8) < 2 * error
