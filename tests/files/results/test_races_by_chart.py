"""Races that a chart sets for the levels of a score sheet."""

import numpy as np
import pytest

from evenbreak.files.results.results_file import read_results

HEADER = "player_a,player_b,score_a,score_b,level_a,level_b"


@pytest.fixture
def read(tmp_path):
    def of_lines(*rows, header=HEADER, chart="apa_8ball"):
        path = tmp_path / "night.csv"
        path.write_text("\n".join([header, *rows, ""]))
        return read_results(path, chart=chart)

    return of_lines


def test_levels_set_the_race_and_so_the_winner(read):
    file = read("Ann,Bo,4,1,5,3", "Ann,Bo,3,2,5,3", "Cy,Di,1,1,2,3", "Ann,Di,3,3,4,4")
    assert np.transpose(file.results.races).tolist() == [[4, 2], [4, 2], [0, 0], [0, 0]]
    winners = [[4, 1], [3, 2]]
    assert np.transpose([file.results.score_a, file.results.score_b])[:2].tolist() == winners
    texts = [text.partition("night.csv")[2] for text in file.warnings]
    assert texts == [
        ": 2 matches get their races from apa_8ball, based on the levels given",
        (
            ":4: the score 1-1 doesn't complete the 2:3 race for the levels given (and 1 more "
            "like this). Check them."
        ),
    ]
    assert len(file.ties) == 1


def test_a_score_sheet_without_races_has_no_ties_left(read):
    rows = ["Ann,Bo,2,2,5,3", "Ann,Bo,4,0,5,3"]
    assert len(read(*rows, chart=None).ties) == 1
    assert read(*rows).ties == ()


def test_stated_races_stay(read):
    file = read("Ann,Bo,5,3,5,3,5,4", header=HEADER + ",race_a,race_b")
    assert np.transpose(file.results.races).tolist() == [[5, 4]]
    assert file.warnings == ()


def test_levels_that_the_chart_does_not_have_leave_the_race_open(read):
    file = read("Ann,Bo,4,1,5,3", "Ann,Cy,3,1,5,8", "Bo,Cy,1,3,,3")
    assert np.transpose(file.results.races).tolist() == [[4, 2], [0, 0], [0, 0]]
    assert any(
        ":3: 2 matches, starting with this one, have neither a race nor levels" in text
        for text in file.warnings
    )


def test_ratings_set_the_race_by_a_chart_of_differences(read):
    file = read("Ann,Bo,5,1,90,80", "Ann,Bo,2,4,90.2,79.8", chart="npl_10")
    assert np.transpose(file.results.races).tolist() == [[5, 4], [5, 4]]


def test_a_chart_that_can_set_no_race_says_so(read):
    points = read("Ann,Bo,4,1,5,3", chart="apa_9ball")
    assert "is a points chart" in points.warnings[0]
    without = read("Ann,Bo,4,1", header="player_a,player_b,score_a,score_b")
    assert "level_a and level_b are missing" in without.warnings[0]
    for file in (points, without):
        assert not np.any(file.results.races)
