"""Which titles of a file mean the columns that are asked for."""

import pytest

from evenbreak.errors import DataError
from evenbreak.files.header import Header
from evenbreak.files.problems import Problems

REQUIRED = {"player": ("name",), "score": ("points", "racks won")}
HEADER = Header(REQUIRED, {"date": ("day",)}, {"score": (("winner",), ("race_a", "race_b"))})


def look(titles, header=HEADER):
    problems = Problems("f.csv")
    places, unused = header.places(titles, 1, problems)
    return places, unused, problems


def test_other_names_and_other_spellings_are_known():
    places, unused, problems = look([" Name", "RACKS_WON", "Day", "club", ""])
    assert (places, unused) == ({"player": 0, "score": 1, "date": 2}, ["club"])
    assert len(problems) == 0


@pytest.mark.parametrize(
    ("titles", "blamed"),
    [
        (["name", "player", "score"], "'name' and 'player' both mean player"),
        (["player"], "no column 'score'"),
        (["1", "7"], "'1', '7'"),
    ],
)
def test_what_is_wrong_is_one_problem(titles, blamed):
    _, _, problems = look(titles)
    assert len(problems) == 1
    with pytest.raises(DataError, match=blamed):
        problems.raise_any()


def test_other_columns_can_take_the_place_of_a_required_one():
    header = Header(REQUIRED, {"race_a": (), "race_b": ()}, {"score": (("race_a", "race_b"),)})
    assert len(look(["player", "race_a", "race_b"], header)[2]) == 0
    assert len(look(["player", "race_a"], header)[2]) == 1


def test_the_separator_that_makes_the_most_known_titles_is_taken():
    possible = {",": ["player;score", " x", " y"], ";": ["player", "score, x, y"]}
    assert HEADER.separator(possible) == ";"
    assert HEADER.separator({",": ["a", "b"], ";": ["a,b"]}) == ","
