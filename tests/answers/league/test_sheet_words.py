import re
from dataclasses import replace

import pytest

from evenbreak.answers.league.report import (
    about_ratings,
    how_even,
    how_rated,
    how_to_read,
    played,
    rating_model,
    source_and_dates,
)
from evenbreak.answers.league.roster_matchups import OfferedRaces
from evenbreak.ratings.prior import PriorChoice
from evenbreak.ratings.results import Results
from leagues import league, sheet_of, two_groups


@pytest.mark.parametrize(
    ("dates", "expected"),
    [
        (None, "season.csv"),
        (["2024-09-03", "2024-09-03"], "season.csv, 2024-09-03"),
        (["2024-09-10", "2024-09-03"], "season.csv, 2024-09-03 to 2024-09-10"),
    ],
)
def test_the_source_has_its_dates_and_no_folder(dates, expected):
    season = Results.from_names(["Ann", "Ann"], ["Bo", "Bo"], [7, 7], [5, 4], date=dates)
    assert source_and_dates(sheet_of(season)) == expected


def test_what_was_played_is_counted_without_forfeits():
    season = Results.from_names(
        ["Ann", "Ann", "Ann"], ["Bo", "Cy", "Di"], [7, 0, 0], [5, 0, 0], forfeit=[0, 1, 1]
    )
    sheet = sheet_of(season)
    assert re.findall(r"[\d,]+", played(sheet)) == ["1", "2", ",", "12"]
    assert any(text.startswith("2 more players") for text in about_ratings(sheet))
    assert not any("groups" in text for text in about_ratings(sheet))


@pytest.mark.parametrize("offered", [OfferedRaces(race_to=7), OfferedRaces((3, 9))])
def test_the_race_that_explains_the_table_is_in_the_table(offered):
    sheet = sheet_of(league(5), offered=offered)
    race, need, other = re.search(
        r"(\d+:\d+) \D+(\d+) games? \D+(\d+)\.", how_to_read(sheet.paired)
    ).groups()
    assert race == f"{need}:{other}"
    assert need != other
    assert race in sheet.races.values()


def test_the_explanation_does_without_an_uneven_race_or_any():
    even = sheet_of(Results.from_names(["Ann"], ["Bo"], [7], [7]))
    assert "7:7" in how_to_read(even.paired)
    apart = sheet_of(two_groups(), players=["Ann", "Cy"])
    assert not re.search(r"\d", how_to_read(apart.paired))


def test_chances_and_lengths_are_those_of_the_races():
    sheet = sheet_of(league(5))
    wins, lengths = how_even(sheet.paired)
    p = sheet.paired["p_win_a"]
    assert re.findall(r"\d+", wins) == [f"{100 * p.min():.0f}", f"{100 * p.max():.0f}"]
    assert f"{sheet.paired['mean_games'].max():.1f} games" in lengths
    assert f"within {sheet.paired['games_p90'].max()}." in lengths
    single = " ".join(how_even(sheet.strongest(2).paired))
    assert "between" not in single
    assert "longest" not in single


def test_pairs_that_cannot_be_compared_are_counted():
    *_, apart = how_even(sheet_of(two_groups()).paired)
    assert " 4 pairs" in apart
    assert any("2 groups" in text for text in about_ratings(sheet_of(two_groups())))


def test_how_it_was_rated():
    season = Results.from_names(["Ann"], ["Bo"], [7], [5], date=["2026-01-31"])
    sheet = sheet_of(season, scale="fargo", prior_sd=0.5)
    assert "500 ± 72.1." in how_rated(sheet)
    tried = (sheet.ratings.prior_sd, (0.1, 0.5, 0.9), (0.7, 0.6, 0.7), 1234, 0.4, 0.6)
    learned, not_learned = PriorChoice(*tried, True, 0.61), PriorChoice(*tried, False, 0.61)
    assert "of 3 values tried, this one predicted 1,234" in how_rated(
        replace(sheet, choice=learned)
    )
    assert how_rated(replace(sheet, choice=not_learned)) == how_rated(sheet)
    aged = sheet_of(season, half_life=90, as_of="2026-02-01")
    assert "half after 90 days, as of 2026-02-01" in how_rated(aged)


def test_the_model_is_the_one_that_was_used():
    season = Results.from_names(["Ann"], ["Bo"], [7], [5], date=["2026-01-31"])
    assert "d/100" in rating_model(sheet_of(season, scale="fargo"))
    assert "count the same" in rating_model(sheet_of(season))
    assert "count the same" not in rating_model(sheet_of(season, half_life=90))
    sheet = sheet_of(season)
    breaks = replace(sheet, ratings=replace(sheet.ratings, break_advantage=12.34))
    assert "12.3 points better" in rating_model(breaks)
    winners = Results.from_names(
        *(["Ann"], ["Bo"], [0], [0]),
        race_a=[7],
        race_b=[7],
        winner=[1],
        unscored=[True],
    )
    assert "only the winner" in rating_model(sheet_of(winners))
