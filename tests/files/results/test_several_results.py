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


def test_titles_may_be_those_of_one_file_or_of_the_files_that_have_them(tmp_path):
    autumn, spring = tmp_path / "autumn.csv", tmp_path / "spring.csv"
    autumn.write_text("Sp 1,Sp 2,Stand\nAnn,Bo,7-5\n")
    spring.write_text("home,away,Stand\nAnn,Bo,3-7\n")
    columns = {"autumn.csv:player_a": "Sp 1", "autumn.csv:player_b": "Sp 2", "score": "Stand"}
    results = read_seasons([autumn, spring], columns=columns).results
    assert results.score_a.tolist() == [7, 3]
    shared = {"player_a": "Sp 1", "player_b": "Sp 2", "score": "Stand"}
    assert read_seasons([autumn, spring], columns=shared).results.score_a.tolist() == [7, 3]
    with pytest.raises(InputError, match=r"'summer\.csv', which isn't one of the files"):
        read_seasons([autumn, spring], columns={**columns, "summer.csv:score": "X"})
    with pytest.raises(InputError, match="'Runde', which isn't a column in any"):
        read_seasons([autumn, spring], columns={**columns, "event": "Runde"})
