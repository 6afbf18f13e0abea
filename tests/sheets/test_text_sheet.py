import re

import pytest

from evenbreak.answers.fair_pairs import RaceLimits, matchups_frame, most_active
from evenbreak.answers.frames import ratings_frame
from evenbreak.answers.sheet_words import how_to_read
from evenbreak.files.results import ResultsFile
from evenbreak.ratings.fit import fit
from evenbreak.ratings.results import Results
from evenbreak.sheets.text_sheet import sheet_text


@pytest.fixture(autouse=True)
def line_of_80(monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")


def text_of(season, *, limits=None, top=10, scale="npl"):
    limits = limits or RaceLimits(race_to=7)
    ratings = fit(season, prior_sd=1.0, scale=scale)
    paired = matchups_frame(ratings, most_active(ratings, top), limits)
    file = ResultsFile(season, "r.csv", (), (), "")
    return sheet_text(file, ratings, limits, ratings_frame(ratings), paired)


def league(players, name="Player {}"):
    names = [name.format(k) for k in range(players)]
    pairs = [(a, b) for a in range(players) for b in range(a + 1, players)]
    return Results.from_names(
        [names[a] for a, _ in pairs],
        [names[b] for _, b in pairs],
        [7] * len(pairs),
        [(a + 2 * b) % 7 for a, b in pairs],
    )


def test_a_small_league_to_the_letter():
    season = Results.from_names(
        ["Ann", "Bo", "Cy"],
        ["Bo", "Cy", "Ann"],
        [7, 7, 3],
        [4, 5, 7],
        date=["2024-09-03", "2024-09-10", "2024-09-17"],
    )
    assert text_of(season, scale="fargo") == (
        "FAIR RACES from r.csv, 2024-09-03 to 2024-09-17\n"
        "\n"
        "3 matches of 3 players, 33 games.\n"
        "Ratings on a Fargo-like scale (100 points double the odds of a game), mean 500.\n"
        "They are nobody's official ratings. Prior: standard deviation 144.3 points.\n"
        "\n"
        "#  player  rating   ±  games  won  lost\n"
        "1  Ann        559  93     21   14     7\n"
        "2  Bo         491  92     23   11    12\n"
        "3  Cy         450  92     22    8    14\n"
        "±: standard error of the rating.\n"
        "\n"
        "The fairest races in which the stronger player needs 7 games.\n"
        "Row: you. Column: your opponent. 7:4: you need 7 games, your opponent 4.\n"
        "\n"
        "          1    2    3\n"
        "1  Ann       7:4  7:3\n"
        "2  Bo   4:7       7:5\n"
        "3  Cy   3:7  5:7\n"
        "\n"
        "The stronger player wins these with a chance of 0.413 to 0.451.\n"
        "The longest of them lasts 9.2 games on average; 9 of 10 end within 11.\n"
    )


@pytest.mark.parametrize("players", [2, 9, 12, 30])
@pytest.mark.parametrize("name", ["P{}", "A Player With A Name Far Too Long To Print {}", "選手{}"])
def test_no_line_is_longer_than_a_page_and_no_name_cut_short_without_need(players, name):
    text = text_of(league(players, name), top=players)
    assert all(len(line) <= 80 for line in text.splitlines())
    if len(name) < 5:
        assert "…" not in text


def test_every_pair_is_printed_once_from_each_side():
    players = 23
    text = text_of(league(players), top=players)
    races = re.findall(r"(?<![\d:])\d+:\d+(?=\s)", text)
    assert len(races) == players * (players - 1)


def test_a_long_list_is_cut_and_said_to_be():
    text = text_of(league(34), top=33)
    assert "#: place among all 34 players." in text
    assert "3 more players are paired in matchups.csv." in text
    assert "1 more player is rated in ratings.csv" in text


def test_square_brackets_in_names_are_no_markup():
    assert "[red]Ann[/red]" in text_of(Results.from_names(["[red]Ann[/red]"], ["Bo"], [7], [5]))


def test_pairs_that_cannot_be_compared_are_told_apart():
    text = text_of(Results.from_names(["Ann", "Cy"], ["Bo", "Di"], [7, 7], [5, 4]))
    assert "2 groups of players never met;" in text
    assert "lost  group" in text
    assert "(4 such pairs)" in " ".join(text.split())
    assert "group" not in text_of(Results.from_names(["Ann"], ["Bo"], [7], [5]))


def test_what_was_left_out_is_told():
    season = Results.from_names(
        ["Ann"] * 3, ["Bo"] * 3, [7, 0, 7], [5, 0, 0], forfeit=[False, False, True]
    )
    assert "Left out: 1 forfeited and 1 at 0-0." in text_of(season)


def test_players_without_games_are_told_and_are_no_group():
    season = Results.from_names(
        ["Ann", "Ann", "Ann"], ["Bo", "Cy", "Di"], [7, 0, 0], [5, 0, 0], forfeit=[0, 1, 1]
    )
    text = " ".join(text_of(season).split())
    assert "1 match of 2 players, 12 games. Left out: 2 forfeited." in text
    assert "2 more players have no game: rated in the middle for want of knowledge." in text
    assert "never met" not in text
    (line,) = (
        line for line in text_of(season, top=4).splitlines() if "Cy" in line and "80" in line
    )
    assert "0    0     0" in line


def test_races_by_length_are_announced_as_such():
    text = text_of(league(3), limits=RaceLimits((7, 13)))
    assert "The fairest races whose longest possible match has 7 to 13 games." in text


def test_the_race_that_explains_the_table_is_in_the_table():
    for limits in (RaceLimits(race_to=7), RaceLimits(race_to=1), RaceLimits((3, 9))):
        text = text_of(league(5), limits=limits)
        example = re.search(r"opponent\. (\d+:\d+): you need (\d+) games?, your", text)
        assert example[1].startswith(f"{example[2]}:")
        assert len(re.findall(rf"(?<!\d){example[1]}(?!\d)", text)) > 1
    even = text_of(Results.from_names(["Ann"], ["Bo"], [7], [7]))
    assert "opponent. 7:7: you need 7 games, your opponent 7." in even
    apart = Results.from_names(["Ann", "Bo"], ["Cy", "Di"], [7, 7], [5, 5])
    pair = matchups_frame(fit(apart), [0, 1], RaceLimits(race_to=7))
    assert how_to_read(pair) == "Row: you. Column: your opponent."


def test_one_game_is_no_games():
    text = text_of(league(3), limits=RaceLimits((1, 1)))
    assert "longest possible match has 1 game.\n" in text
    assert "1:1: you need 1 game, your opponent 1." in text
    assert "player needs 1 game.\n" in text_of(league(3), limits=RaceLimits(race_to=1))


def test_races_of_several_lengths_are_accounted_for():
    why = "Each pair gets the race nearest to even, whatever its length."
    assert why in text_of(league(5), limits=RaceLimits((3, 13)))
    assert why not in text_of(league(5), limits=RaceLimits((13, 13)))
    assert why not in text_of(league(5))


def test_ratings_on_a_fine_scale_have_more_decimals():
    season = Results.from_names(["Ann"], ["Bo"], [7], [5])
    assert " 0.104 " in text_of(season, scale=0.5)


def test_a_season_of_one_day_is_told_so():
    season = Results.from_names(["Ann"], ["Bo"], [7], [5], date=["2024-09-03"])
    assert text_of(season).startswith("FAIR RACES from r.csv, 2024-09-03\n")
