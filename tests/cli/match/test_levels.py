"""Two players by their skill levels: typed, or on a list, in every question about a match."""

import csv
import io
import json

import pytest

from evenbreak.games import Race, Rack
from evenbreak.handicaps import Gap, level_skills, points_odds
from evenbreak.matches import win_probability

APA = ("--chart", "apa_8ball")


@pytest.fixture
def club(tmp_path):
    def write(text, name="club.csv"):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return str(path)

    return write


def answer(run, *words):
    result = run(*words, "--json")
    assert result.exit_code == 0, result.stderr
    return json.loads(result.stdout)


def test_the_chart_sets_the_race_and_the_levels_the_chance(run):
    skills, found = level_skills("apa_8ball"), answer(run, "odds", "5", "3", *APA)
    gap = Gap(skills.difference(5, 3), skills.error(5, 3), "fargo")
    assert found["p_win_a"] == pytest.approx(gap.win(4, 2))
    assert (found["level_a"], found["level_b"], found["levels_source"]) == (5, 3, "measured")
    own_race = answer(run, "odds", "5", "3", *APA, "--race", "5:3")
    assert own_race["p_win_a"] == pytest.approx(gap.win(5, 3))
    terminal = run("odds", "5", "3", *APA).stderr
    assert "Race 4:2" in terminal
    assert "about 40,000 matches in other leagues" in terminal


def test_a_chart_of_differences_sets_the_race_of_ratings(run):
    found = answer(run, "odds", "612", "521", "--chart", "fargo_r6_hot")
    p = 1 / (1 + 2**-0.91)
    assert found["p_win_a"] == pytest.approx(win_probability(Race(7, 4, Rack(p))))


def test_fair_races_formats_and_a_match_under_way_go_by_levels(run):
    skills = level_skills("apa_8ball")
    (best, *_) = answer(run, "fair", "5", "3", *APA, "--race-to", "5")["races"]
    gap = Gap(skills.difference(5, 3), skills.error(5, 3), "fargo")
    assert best["p_win_a"] == pytest.approx(gap.win(best["race_a"], best["race_b"]))
    now = answer(run, "live", "7", "4", *APA, "--racks", "aab")["now"]
    left = Race(5, 2, Rack(skills.chance(7, 4)), score=(2, 1))
    assert now["p_win_a"] == pytest.approx(win_probability(left))
    formats = run("compare", "5", "3", *APA, "4:2", "5:3", "--csv").stdout
    assert len(list(csv.DictReader(io.StringIO(formats)))) == 2


def test_names_on_a_list_have_levels_and_perhaps_ratings(run, club):
    levels = club("player,level\nAnn,5\nBo,3\n")
    both = club("player,Fargo rating,level\nAnn,600,5\nBo,500,3\n", "both.csv")
    by_level = answer(run, "odds", "Ann", "Bo", "--from", levels, *APA)
    assert by_level["p_win_a"] == answer(run, "odds", "5", "3", *APA)["p_win_a"]
    by_rating = answer(run, "odds", "Ann", "Bo", "--from", both, *APA)
    assert by_rating["p_win_a"] == pytest.approx(win_probability(Race(4, 2, Rack(2 / 3))))
    assert "levels_source" not in by_rating


def test_points_to_win_are_an_assumption_with_its_range(run, club):
    odds = points_odds("apa_9ball", 7, 4, score=(30, 5))
    found = answer(run, "live", "7", "4", "--chart", "apa_9ball", "--score", "30:5")
    assert found["p_win_a"] == pytest.approx(odds.p_win_1)
    assert found["match_points_a"] == pytest.approx(odds.share_1)
    low, high = found["p_win_a_range"]
    assert low < found["p_win_a"] < high
    assert "neither has been measured" in run("odds", "7", "4", "--chart", "apa_9ball").stderr
    names = club("player,SL\nAnn,7\nBo,4\n")
    named = ("odds", "Ann", "Bo", "--from", names, "--chart", "apa_9ball")
    assert answer(run, *named)["needs_a"] == 55


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (("odds", "612", "521", *APA), "612 isn't a skill level in apa_8ball"),
        (("odds", "5.5", "3", *APA), "5.5 isn't a skill level in apa_8ball"),
        (("odds", "5", "3", "--chart", "fargo_r6_hot"), "5 don't look like Fargo ratings"),
        (("odds", "5", "3", *APA, "--scale", "2"), "--scale is for ratings"),
        (("fair", "5", "3", *APA, "--scale", "npl"), "--scale is for ratings"),
        (
            ("odds", "5", "3", "--race", "4:2", "--results", "x.csv"),
            "--results is for chances based on",
        ),
        (
            ("odds", "85", "80", "--chart", "npl_8", "--results", "x"),
            "--results is for chances based on",
        ),
        (("odds", "--p", "0.6", *APA), "--chart is for ratings or skill levels"),
        (("odds", "5", "3", "--race", "5"), "3 to 5 look like skill levels, not ratings. Add --ch"),
        (("fair", "5", "3"), "Add --chart apa_8ball or --chart apa_9ball, or --scale npl if they"),
        (("odds", "5", "3"), "give --race M:N, --ahead M:N or --chart"),
        (
            ("odds", "5", "3", "--chart", "apa_9ball", "--race", "5:3"),
            "--race isn't for a points chart",
        ),
        (
            ("live", "5", "3", "--chart", "apa_9ball", "--racks", "ab"),
            "--racks isn't for a points chart",
        ),
        (("live", "5", "3", "--chart", "apa_9ball", "--score", "40:3"), "the match is over"),
        (("fair", "5", "3", "--chart", "apa_9ball"), "must be a chart of races by skill level"),
        (("fair", "85", "80", "--chart", "npl_8"), "must be a chart of races by skill level"),
    ],
)
def test_what_does_not_go_together_is_refused(run, words, says):
    result = run(*words)
    assert (result.exit_code, result.stdout) == (2, "")
    assert says in result.stderr


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("player,level\nAnn,5\nBo,9\n", "'Bo' has skill level 9"),
        ("player,level\nAnn,5\nBo,\n", "'Bo' has no skill level"),
        ("player,rating\nAnn,612\nBo,521\n", "needs skill levels"),
    ],
)
def test_a_list_without_the_levels_is_refused(run, club, text, says):
    result = run("odds", "Ann", "Bo", "--from", club(text), *APA)
    assert result.exit_code == 2
    assert says in result.stderr


@pytest.mark.parametrize(
    ("chart", "typed", "says"),
    [
        ("apa_8ball", ("odds", "5", "3"), "Race 4:2"),
        ("apa_8ball", ("odds", "Ann", "Bo"), "Ann level 5, Bo level 3"),
        ("apa_8ball", ("odds", "612", "521", "--race", "7:5"), "A rated 612"),
        ("apa_8ball", ("odds", "--p", "0.6", "--race", "7:5"), "probability 0.6"),
        ("apa_8ball", ("fair", "612", "521", "--race-to", "7"), "A rated 612"),
        ("apa_9ball", ("odds", "5", "3"), "38 points against 25"),
        ("fargo_r6_hot", ("odds", "612", "521"), "Race 7:4"),
        ("fargo_r6_hot", ("fair", "612", "521", "--race-to", "7"), "A rated 612"),
    ],
)
def test_in_a_leagues_folder_its_chart_gives_way_to_what_is_typed(run, club, chart, typed, says):
    club("player,level\nAnn,5\nBo,3\n")
    club("player_a,player_b,score_a,score_b\nAnn,Bo,4,1\n", "season.csv")
    league = club(
        f'chart = "{chart}"\n[files]\nroster = "club.csv"\n[[results]]\nfile = "season.csv"\n',
        "league.toml",
    )
    result = run(*typed, "--league", league)
    assert result.exit_code == 0, result.stderr
    assert says in result.stderr
