"""Several seasons in a row, read as one."""

import pytest

from evenbreak.errors import InputError
from evenbreak.files import read_seasons


@pytest.fixture(name="seasons")
def seasons_fixture(tmp_path):
    last, this = tmp_path / "last.csv", tmp_path / "this.csv"
    last.write_text("player_a,player_b,score_a,score_b,team_a,team_b\nAnn,Bo,7,5,X,Y\n")
    this.write_text("date,player_a,player_b,score_a,score_b\n2026-01-09,BO,Cy,7,2\n")
    return last, this


def test_players_and_matches_are_those_of_both(seasons):
    file = read_seasons(seasons)
    results = file.results
    assert results.players == ("Ann", "Bo", "Cy")
    assert results.player_a.tolist() == [0, 1]
    assert results.score_b.tolist() == [5, 2]
    assert str(seasons[0]) in file.source
    assert str(seasons[1]) in file.source


def test_a_column_of_one_file_is_not_stated_in_the_other(seasons):
    results = read_seasons(seasons).results
    assert results.team_a.tolist() == ["X", ""]
    assert results.date.astype(str).tolist() == ["NaT", "2026-01-09"]


def test_one_file_is_itself(seasons):
    assert read_seasons(seasons[:1]).source == str(seasons[0])


def test_the_same_file_twice_is_refused(seasons):
    with pytest.raises(InputError, match=r"last.csv"):
        read_seasons([seasons[0], seasons[0]])
