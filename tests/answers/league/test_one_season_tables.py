"""The tables of one season in full: readers take them for results and for a roster."""

from __future__ import annotations

import pytest

from evenbreak.answers.league.season_tables import matches_frame, truth_frame
from evenbreak.files.csv_writer import to_csv
from evenbreak.files.lists.season import read_season_players
from evenbreak.files.results.results_file import read_results
from evenbreak.league import LeaguePlayers, PlayedSeason, Season, season_matches

NAMES = ["Ann", "Bo", "Cy", "Di", "Ed"]


@pytest.fixture(scope="module")
def played() -> tuple[Season, PlayedSeason]:
    players = LeaguePlayers.of(
        [90, 84, 50, 60, 61], skill=[95, 80, 70, 55, 62], drift=[0, 0.4, 0, -0.3, 0], names=NAMES
    )
    season = Season(players, "npl", "npl_10", weeks=8)
    return season, season_matches(season, seed=1)


def test_a_match_stands_in_a_row_with_who_won_each_of_its_racks(played):
    frame = matches_frame(played[1])
    assert list(frame.columns) == [
        *("date", "event", "player_a", "player_b"),
        *("race_a", "race_b", "score_a", "score_b", "racks"),
    ]
    assert frame["event"].iloc[-1] == "week 8"
    assert (frame["racks"].str.count("a") == frame["score_a"]).all()
    assert (frame["racks"].str.count("b") == frame["score_b"]).all()


def test_matches_are_read_back_as_results(played, tmp_path):
    (tmp_path / "matches.csv").write_bytes(to_csv(matches_frame(played[1])))
    back, results = read_results(tmp_path / "matches.csv").results, played[1].results
    for side in ("player_a", "player_b"):
        names = [back.players[k] for k in getattr(back, side)]
        assert names == [results.players[k] for k in getattr(results, side)]
    assert back.score_a.tolist() == results.score_a.tolist()
    assert back.racks.tolist() == results.racks.tolist()
    assert (back.date == results.date).all()


def test_the_truth_is_read_back_as_a_league(played, tmp_path):
    season, one = played
    truth = truth_frame(season, one)
    assert truth["rating"].tolist() == [90, 84, 50, 60, 61]
    assert truth["skill"].tolist() == [95, 80, 70, 55, 62]
    assert truth["rating_end"].tolist() == one.rating.tolist()
    assert truth["skill_end"].tolist() == one.skill_after.tolist()
    (tmp_path / "truth.csv").write_bytes(to_csv(truth))
    back = read_season_players(tmp_path / "truth.csv").players
    assert list(back.names or ()) == NAMES
    assert back.rating.tolist() == [90, 84, 50, 60, 61]
    assert back.skill.tolist() == [95, 80, 70, 55, 62]
