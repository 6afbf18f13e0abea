"""Which titles of a file mean the columns that are asked for."""

import pytest

from evenbreak.errors import DataError
from evenbreak.files.tables.header import Header
from evenbreak.files.tables.problems import Problems
from rows import each_of

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


COMPLETE = ["name", "points"]


@each_of(
    "rows, above",
    [
        ([COMPLETE], 0),
        ([["Autumn league"], COMPLETE], 1),
        ([["Autumn", "2024"], ["", ""], ["as of", "12"], COMPLETE, ["day", "name"]], 3),
        ([["score"], COMPLETE], 1),
        ([["name", "7"], COMPLETE], 1),
        ([COMPLETE, ["name", "score", "day"]], 0),
        ([["wer", "was"], ["player", "7"], ["day", "8"]], 0),
        ([["wer", "was"], ["player", "x"]], 0),
        ([["title"], ["day", "player", "punkte"]], 1),
        ([["title"], ["wann", "wer", "was"], ["1", "2", "3"]], 1),
        ([["score"], ["wann", "wer", "was"], ["1", "2", "3"]], 1),
    ],
)
def test_the_header_is_the_row_with_the_most_known_titles(rows, above):
    assert -HEADER.best(rows).above == above


def test_a_file_without_rows_has_no_header():
    assert not HEADER.best([]).complete


def test_a_title_can_be_given_a_meaning_whatever_it_meant():
    header = Header(REQUIRED, {"date": ("day",)}, {}, {"player": "Wer", "score": "name"})
    places, unused, problems = look(["WER ", "name", "player", "points"], header)
    assert (places, unused, len(problems)) == ({"player": 0, "score": 1}, ["player", "points"], 0)
    _, _, problems = look(["name", "points"], header)
    assert "'Wer'" in problems.listed()[0]
    assert len(problems) == 1


def test_a_hint_makes_one_problem_of_all_missing_columns():
    header = Header(REQUIRED, {}, {}, {}, lambda *given: f"call {given[1][0]} so")
    _, _, problems = look(["wer", "was"], header)
    (told,) = problems.listed()
    assert "'player' and 'score'" in told
    assert told.endswith("call wer so")
