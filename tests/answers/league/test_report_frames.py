import numpy as np
import pytest

from evenbreak import __version__
from evenbreak.answers.league.roster_matchups import OfferedRaces
from evenbreak.answers.league.sheet import count_groups, dates_of, matchups_frame, summary_frame
from evenbreak.files.results.results_file import ResultsFile
from evenbreak.ratings.fit import fit
from evenbreak.ratings.results import Results


@pytest.fixture(scope="module")
def season():
    return Results.from_names(
        ["Bo", "Bo", "Cy", "Di", "Ann"],
        ["Ann", "Cy", "Ann", "Ed", "Cy"],
        [4, 7, 3, 0, 0],
        [7, 5, 7, 5, 0],
        date=np.array(["2024-09-10", "NaT", "2024-09-03", "2024-08-01", "2025-01-01"], "M8[D]"),
        forfeit=[False, False, False, True, False],
    )


@pytest.fixture(scope="module")
def file(season):
    return ResultsFile(season, "some/where/r.csv", (), (("Ann", "Anne"),), "0123")


def test_the_summary_says_what_was_read_and_left_out(season, file):
    ratings = fit(season, scale="elo")
    offered = OfferedRaces((5, 9))
    frame = summary_frame(file, ratings, matchups_frame(ratings, range(5), offered), offered)
    facts = dict(zip(frame["key"], frame["value"], strict=True))
    expected = {
        "results_file": "r.csv",
        "results_sha256": "0123",
        "matches_read": 5,
        "matches_used": 3,
        "forfeits_left_out": 1,
        "empty_left_out": 1,
        "first_date": "2024-09-03",
        "last_date": "2024-09-10",
        "games": 33,
        "player_count": 5,
        "players_without_games": 2,
        "components": 1,
        "groups_of_similar_names": 1,
        "anchor": 1500.0,
        "prior_sd_log_odds": ratings.prior_sd,
        "race_to": None,
        "games_lo": 5,
        "games_hi": 9,
        "pairs": 10,
        "pairs_without_race": 0,
        "evenbreak_version": __version__,
    }
    assert {key: facts[key] for key in expected} == expected
    assert "Elo-like" in facts["scale"]
    assert "not an official rating" in facts["scale"]
    assert facts["prior_sd_points"] == pytest.approx(
        ratings.prior_sd * ratings.scale.points_per_log_odds
    )


def test_a_file_without_dates_has_none_in_its_summary():
    season = Results.from_names(["Ann"], ["Bo"], [7], [5])
    bare = ResultsFile(season, "stdin", (), (), "")
    ratings, offered = fit(season), OfferedRaces(race_to=7)
    frame = summary_frame(bare, ratings, matchups_frame(ratings, [0, 1], offered), offered)
    facts = dict(zip(frame["key"], frame["value"], strict=True))
    assert (facts["first_date"], facts["last_date"], facts["results_file"]) == ("", "", "stdin")


def test_players_known_by_winners_alone_are_no_players_without_results():
    season = Results.from_names(
        ["Ann", "Bo"],
        ["Bo", "Cy"],
        [0, 0],
        [0, 0],
        race_a=[7, 7],
        race_b=[5, 5],
        winner=[1, 1],
        unscored=[True, True],
        date=["2026-01-05", "2026-01-12"],
    )
    ratings = fit(season)
    assert not ratings.idle.any()
    assert count_groups(ratings) == 1
    assert dates_of(season) == ("2026-01-05", "2026-01-12")
