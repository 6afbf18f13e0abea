"""`evenbreak tournament odds`: the odds of tonight's tournament."""

import json

import pytest

ENTRANTS = "player,rating\nAnn,640\nBo,600\nCy,560\nDi,520\nEd,480\nFlo,440\nGus,400\nHal,360\n"
FARGO = ("--scale", "fargo")


@pytest.fixture
def odds(run, tmp_path):
    def ask(*words, entrants=ENTRANTS):
        path = tmp_path / "entrants.csv"
        path.write_text(entrants)
        result = run("tournament", "odds", str(path), *words, "--json")
        assert result.exit_code == 0, result.stderr
        return json.loads(result.stdout)

    return ask


def column(answer, name):
    return [player[name] for player in sorted(answer["players"], key=lambda row: row["seed"])]


def test_eight_players_one_game_a_match(odds):
    """The published table: Fargo 700 to 420, one game a match."""
    ratings = range(700, 419, -40)
    listed = "player,rating\n" + "".join(f"P{points},{points}\n" for points in ratings)
    answer = odds("--race", "1", *FARGO, entrants=listed)
    assert column(answer, "p_title") == pytest.approx(
        [0.454415, 0.268084, 0.145224, 0.073044, 0.034337, 0.015342, 0.006688, 0.002866], abs=1e-6
    )
    assert answer["p_second_final"] == pytest.approx(0.474448, abs=1e-6)
    assert answer["matches_mean"] == pytest.approx(14 + answer["p_second_final"])
    assert answer["exact"]


def test_places_sum_to_one(odds):
    answer = odds("--race", "7", "--losers-race", "5", "--final-race", "9", *FARGO)
    names = ["p_title", "p_second", "p_third", "p_fourth", "p_5_6", "p_7_8"]
    for player in answer["players"]:
        assert sum(player[name] for name in names) == pytest.approx(1.0)
    assert sum(column(answer, "p_title")) == pytest.approx(1.0)


def test_the_favorite_comes_first_and_races_matter(odds):
    short, long = (odds("--race", race, *FARGO) for race in ("3", "9"))
    assert long["players"][0]["name"] == "Ann"
    assert long["players"][0]["p_title"] > short["players"][0]["p_title"]
    fair = odds("--race-to", "9", *FARGO)
    assert fair["players"][0]["p_title"] < short["players"][0]["p_title"]


def test_uncertain_ratings_are_averaged_over_unless_sure(odds):
    unsure = ENTRANTS.replace("rating\n", "rating,standard_error\n").replace("0\n", "0,60\n")
    averaged = odds("--race", "5", *FARGO, entrants=unsure)
    sure = odds("--race", "5", "--sure", *FARGO, entrants=unsure)
    assert averaged["ratings_averaged"]
    assert not sure["ratings_averaged"]
    assert column(averaged, "p_title")[0] < column(sure, "p_title")[0]
    assert column(averaged, "p_title_if_sure") == pytest.approx(column(sure, "p_title"))


def test_walkovers_help_the_weak_and_prizes_are_shared(odds):
    plain = odds("--race", "5", *FARGO, "--prizes", "100,50")
    often = odds("--race", "5", *FARGO, "--walkovers", "0.2")
    assert column(often, "p_title")[-1] > column(plain, "p_title")[-1]
    assert sum(column(plain, "prize_mean")) == pytest.approx(150.0)


def test_a_draw_as_it_was_made(odds, run, tmp_path):
    drawn = "player,rating\nAnn,600\nBo,600\nCy,600\nbye 1,\n"
    answer = odds("--race", "1", *FARGO, "--format", "single", "--seeding", "drawn", entrants=drawn)
    assert column(answer, "name") == ["Ann", "Bo", "Cy"]
    assert column(answer, "p_title") == pytest.approx([0.25, 0.25, 0.5])
    path = tmp_path / "three.csv"
    path.write_text("player,rating\nAnn,600\nBo,600\nCy,600\n")
    result = run("tournament", "odds", str(path), "--race", "1", *FARGO, "--seeding", "drawn")
    assert result.exit_code == 2
    assert "bye 1" in result.stderr


@pytest.mark.slow
def test_formats_and_seeding(odds):
    single = odds("--race", "5", *FARGO, "--format", "single", "--third-place")
    assert single["p_second_final"] == 0.0
    assert single["matches_mean"] == 8.0
    assert single["rematches_mean"] == 0.0
    assert "p_third" in single["players"][0]
    robin = odds("--race", "5", *FARGO, "--format", "round-robin")
    assert robin["matches_mean"] == 28.0
    upside = "player,rating\n" + "\n".join(reversed(ENTRANTS.split("\n")[1:-1]))
    rated = odds("--race", "5", *FARGO, "--seeding", "rating", entrants=upside)
    assert column(rated, "name")[:2] == ["Ann", "Bo"]
    blind = [
        column(odds("--race", "5", *FARGO, "--seeding", "blind", "--seed", seed), "name")
        for seed in ("1", "1", "2")
    ]
    assert blind[0] == blind[1] != blind[2]


@pytest.mark.slow_after(1)
@pytest.mark.parametrize(
    ("words", "matches"),
    [
        (("--format", "pods", "--pod-size", "4"), 13),
        (("--format", "pods", "--pod-size", "4", "--qualifiers", "2"), 13),
        (("--format", "groups", "--groups", "2"), 15),
        (("--format", "groups", "--groups", "2", "--qualifiers", "1"), 13),
        (("--qualifiers", "4", "--drops", "usual"), 13),
    ],
)
def test_formats_with_a_second_stage(odds, words, matches):
    answer = odds("--race", "5", *FARGO, *words)
    assert answer["matches_mean"] == matches
    assert sum(column(answer, "p_title")) == pytest.approx(1.0)


def test_before_the_draw(odds):
    """A favorite meets an average opponent, whoever is drawn to them."""
    level = "player,rating\nAnn,600\n" + "".join(f"P{k},500\n" for k in range(7))
    answer = odds("--race", "1", *FARGO, "--before-draw", entrants=level)
    assert not answer["exact"]
    assert column(answer, "p_title")[0] == pytest.approx(800 / 2187)
    unsure = level.replace("rating\n", "rating,standard_error\n").replace("0\n", "0,60\n")
    averaged = odds("--race", "1", *FARGO, "--before-draw", entrants=unsure)
    assert averaged["ratings_averaged"]
    assert column(averaged, "p_title_if_sure")[0] == pytest.approx(800 / 2187)


def test_qualifiers_drawn_later(odds):
    drawn = odds("--race", "5", *FARGO, "--qualifiers", "4", "--placement", "redraw")
    crossed = odds("--race", "5", *FARGO, "--qualifiers", "4")
    gap = column(drawn, "p_title")[0] - column(crossed, "p_title")[0]
    assert 0.0 < abs(gap) < 0.05
    assert drawn["exact"]


@pytest.mark.slow
def test_the_handicap_of_a_whole_tournament(odds):
    even = odds("--race", "7", *FARGO)
    assert "p_title_stronger_half" not in even
    fair = odds("--race-to", "7", "--losers-race", "5", *FARGO, "--fairest")
    assert 0.45 < fair["p_title_stronger_half"] < 0.55
    first = fair["players"][0]
    assert first["times_equal_share"] == pytest.approx(8 * first["p_title"])
    today, best, *_ = fair["fairer_races"]
    assert today["race"] == "to 7"
    assert best["unfairness"] <= today["unfairness"] == pytest.approx(fair["unfairness"])
    assert best["games_mean"] <= 1.02 * today["games_mean"]
    assert fair["unfairness_by_round"] < best["unfairness"]
    assert 0.95 <= fair["games_mean_by_round"] / today["games_mean"] <= 1.05
    assert {row["race_today"] for row in fair["races_by_round"]} == {"to 7", "to 5"}
    hot = odds("--chart", "fargo_r6_hot", *FARGO)
    assert hot["p_title_stronger_half"] > 0.6


def test_swiss(odds):
    pytest.importorskip("caissify_pairings", reason="needs the extra 'swiss'")
    answer = odds("--race", "5", *FARGO, "--format", "swiss", "--rounds", "4")
    assert not answer["exact"]
    assert sum(column(answer, "p_title")) == pytest.approx(1.0)
    assert column(answer, "p_title")[0] > 0.5


@pytest.mark.parametrize(
    ("words", "named"),
    [
        ((), "--race"),
        (("--race", "5", "--fairest"), "--fairest"),
        (("--race", "5", "--qualifiers", "3"), "--qualifiers"),
        (("--race", "5", "--format", "groups", "--drops", "usual"), "--drops"),
        (("--race", "5", "--placement", "redraw"), "--placement"),
        (("--race", "5", "--before-draw", "--seeding", "rating"), "--before-draw"),
        (("--race", "5", "--before-draw", "--format", "swiss"), "--before-draw"),
        (("--race", "5", "--format", "groups", "--groups", "5"), "groups is 5"),
        (("--race", "5", "--race-to", "5"), "--race-to"),
        (("--chart", "npl_10", "--losers-race", "5"), "--losers-race"),
        (("--race", "5", "--format", "single", "--final", "single"), "--final"),
        (("--race", "5", "--third-place"), "--third-place"),
        (("--race", "5", "--format", "single", "--losers-race", "4"), "--losers-race"),
        (("--race", "5", "--format", "round-robin", "--final-race", "7"), "--final-race"),
        (("--race", "5", "--qualifiers", "4", "--final", "single"), "--qualifiers"),
        (("--race", "5", "--prizes", "a lot"), "a lot"),
        (("--race", "5", "--prizes", "9,8,7,6,5,4,3,2,1"), "--prizes"),
        (("--race", "5", "--walkovers", "5%"), "5%"),
    ],
)
def test_wrong_options_are_refused(run, tmp_path, words, named):
    path = tmp_path / "entrants.csv"
    path.write_text(ENTRANTS)
    result = run("tournament", "odds", str(path), *FARGO, *words)
    assert result.exit_code == 2
    assert named in result.stderr


@pytest.mark.parametrize(
    ("listed", "code", "named"),
    [
        ("player,rating\nAnn,640\n", 2, "entrants.csv"),
        ("Ann\nBo\n", 2, "ratings"),
        ("player,rating\nAnn,640\nAnn,600\n", 3, "entrants.csv:3"),
    ],
)
def test_wrong_lists_are_refused(run, tmp_path, listed, code, named):
    path = tmp_path / "entrants.csv"
    path.write_text(listed)
    result = run("tournament", "odds", str(path), "--race", "5", *FARGO)
    assert result.exit_code == code
    assert named in result.stderr
