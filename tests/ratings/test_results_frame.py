"""Results from a DataFrame: what each cell may hold, and errors that name its row."""

from datetime import date

import numpy as np
import pandas as pd
import pytest

from evenbreak.errors import DataError, InputError
from evenbreak.files import read_results
from evenbreak.ratings import Results, fit
from evenbreak.ratings.results_frame import (
    FORFEIT_WORDS,
    FORMAT_WORDS,
    FORMATS,
    FrameReader,
    letters,
)
from places import DATA
from rows import each_of


def frame(**columns):
    given = {"player_a": ["Ann", "Bo"], "player_b": ["Bo", "Cy"], "score_a": [7, 4]}
    return pd.DataFrame({**given, "score_b": [5, 7], **columns})


def test_a_frame_holds_what_the_file_holds():
    path = DATA / "demo_league.csv"
    from_file = read_results(path).results
    found = Results.from_frame(pd.read_csv(path))
    assert found.players == from_file.players
    for name in ("player_a", "player_b", "score_a", "score_b", "race_a", "race_b", "forfeit"):
        np.testing.assert_array_equal(getattr(found, name), getattr(from_file, name))
    for name in ("date", "first_break", "break_format", "event"):
        np.testing.assert_array_equal(getattr(found, name), getattr(from_file, name))
    np.testing.assert_array_equal(fit(found).rating, fit(from_file).rating)


@pytest.mark.parametrize("known", [{}, {"race_a": 7, "race_b": 7, "winner": ["a", "b"]}])
def test_the_work_for_each_row_does_not_grow_with_the_rows(monkeypatch, known):
    """However many rows: each column is looked up, or made where there is none, as often."""
    looked_up = []
    cells = FrameReader.cells

    def counting(self, name):
        looked_up.append(name)
        return cells(self, name)

    monkeypatch.setattr(FrameReader, "cells", counting)
    counts = []
    for rows in (1, 2, 300):
        Results.from_frame(pd.concat([frame(**known)] * rows, ignore_index=True))
        counts.append(len(looked_up))
        looked_up.clear()
    assert counts[0] == counts[1] == counts[2]


@pytest.mark.parametrize("kind", ["Int64", "float", "object", "string", "category"])
def test_numbers_may_have_any_type(kind):
    scores = pd.Series([5, 7]).astype(str).astype(kind) if kind == "string" else pd.Series([5, 7])
    assert Results.from_frame(frame(score_b=scores.astype(kind))).score_b.tolist() == [5, 7]


@pytest.mark.parametrize(
    "days",
    [
        ["2026-01-31", None],
        [date(2026, 1, 31), None],
        pd.to_datetime(["2026-01-31 20:15", None]),
        np.array(["2026-01-31", "NaT"], dtype="datetime64[D]"),
    ],
)
def test_days_may_be_text_dates_or_timestamps(days):
    assert Results.from_frame(frame(date=days)).date.astype(str).tolist() == ["2026-01-31", "NaT"]


def test_titles_may_be_written_as_in_files():
    titles = {"player_a": "Player A", "score_b": "SCORE B"}
    assert len(Results.from_frame(frame().rename(columns=titles))) == 2


def test_sides_are_letters_or_names():
    found = Results.from_frame(frame(winner=["Ann", "b"], first_break=["Bo", None]))
    assert found.winner.tolist() == [1, 2]
    assert found.first_break.tolist() == [2, 0]


def test_a_match_may_be_known_by_race_and_winner_alone():
    known = frame(score_a=[7, None], score_b=[5, None], race_a=7, race_b=7, winner=["a", "b"])
    assert Results.from_frame(known).unscored.tolist() == [False, True]


def test_a_forfeit_needs_no_score():
    found = Results.from_frame(frame(score_a=[7, None], score_b=[5, None], forfeit=["no", "yes"]))
    assert found.forfeit.tolist() == [False, True]


@each_of(
    "columns, named",
    [
        ({"score_b": [5, 2.5]}, r"row 1: score_b must be a whole number, 0 or more; you gave 2\.5"),
        ({"score_b": [5, -1]}, "row 1: score_b must be a whole number, 0 or more; you gave -1"),
        (
            {"score_b": [5, "7-5"]},
            "row 1: score_b must be a whole number, 0 or more; you gave '7-5'",
        ),
        ({"score_b": [5, None]}, "row 1: score_b must not be empty"),
        ({"score_b": [5, True]}, "row 1: score_b must be a whole number, 0 or more; you gave True"),
        (
            {"score_b": [5, 10**30]},
            "row 1: score_b must be a whole number, 0 or more; you gave 1000",
        ),
        ({"player_b": ["Bo", None]}, "row 1: player_b must not be empty"),
        ({"player_b": ["Bo", 7]}, "row 1: player_b must"),
        ({"player_b": ["Bo", "Bo"]}, r"row 1: .*both sides|row 1: .*'Bo'"),
        (
            {"date": ["2026-01-31", "31/1/2026"]},
            "row 1: date must be a date such as 2026-01-31; you gave '31/1/2026'",
        ),
        (
            {"date": ["2026-01-31", 20260131]},
            "row 1: date must be a date such as 2026-01-31; you gave 20260131",
        ),
        (
            {"winner": ["a", "Zoe"]},
            "row 1: winner must be a, b or the name of one of the players; you gave 'Zoe'",
        ),
        ({"winner": ["a", "a"], "race_a": 7, "race_b": 7}, r"row 1: winner"),
        (
            {"forfeit": [False, "perhaps"]},
            "row 1: forfeit must be True or False, yes or no; you gave 'perhaps'",
        ),
        (
            {"forfeit": [False, []]},
            r"row 1: forfeit must be True or False, yes or no; you gave \[\]",
        ),
        (
            {"break_format": ["winner", "random"]},
            "row 1: break_format must be winner, loser, alternate, a or b; you gave 'random'",
        ),
        (
            {"racks": ["aaaaaaabbbbb", "abc"]},
            "row 1: racks must be letters a and b, such as 'abba'; you gave 'abc'",
        ),
        ({"race_a": [7, 7], "race_b": [7, 9]}, r"row 1: "),
    ],
)
def test_errors_name_the_row(columns, named):
    with pytest.raises(DataError, match=named):
        Results.from_frame(frame(**columns))


def test_rows_are_called_by_their_labels_and_all_problems_come_at_once():
    wrong = frame(score_a=["x", 4], score_b=[5, "y"]).set_index(pd.Index(["first", "second"]))
    with pytest.raises(DataError) as caught:
        Results.from_frame(wrong)
    assert [line[:16] for line in caught.value.problems] == ["row first: score", "row second: scor"]


def test_many_problems_are_counted():
    wrong = pd.concat([frame(score_a=["x", "y"])] * 50, ignore_index=True)
    with pytest.raises(DataError, match="and 80 more problems"):
        Results.from_frame(wrong)


def test_missing_and_repeated_columns_are_named():
    with pytest.raises(DataError, match="no column score_b"):
        Results.from_frame(frame().drop(columns="score_b"))
    twice = frame().assign(**{"Player A": "Di"})
    with pytest.raises(DataError, match="two columns mean player_a"):
        Results.from_frame(twice)


def test_columns_that_are_not_used_are_named_in_a_warning():
    with pytest.warns(UserWarning, match="columns not used: table"):
        Results.from_frame(frame(table=[1, 2]))


@pytest.mark.parametrize("wrong", [[("Ann", "Bo", 7, 5)], "season.csv", None])
def test_only_frames_are_read(wrong):
    with pytest.raises(InputError, match="must be a DataFrame"):
        Results.from_frame(wrong)


@pytest.mark.parametrize("word", ["walkover", "w/o", "t", "Yes", True, 1])
def test_a_frame_knows_the_words_for_a_forfeit_that_a_file_knows(word):
    frame = pd.DataFrame(
        {
            "player_a": ["Ann", "Bo"],
            "player_b": ["Bo", "Cy"],
            "score_a": [5, None],
            "score_b": [3, None],
            "forfeit": [None, word],
            "break_format": ["alternating", None],
        }
    )
    found = Results.from_frame(frame)
    assert found.forfeit.tolist() == [False, True]
    assert found.break_format.tolist() == [FORMATS.index("alternate"), 0]


def test_names_that_differ_in_case_or_blanks_are_one_players_as_in_files(tmp_path):
    wild = frame(player_a=["Ann", "BO"], player_b=["Bo", "Cy"], winner=["ann", "cy"])
    with pytest.warns(UserWarning, match="'BO' is read as 'Bo'"):
        found = Results.from_frame(wild)
    path = tmp_path / "season.csv"
    wild.to_csv(path, index=False)
    from_file = read_results(path).results
    assert found.players == from_file.players == ("Ann", "Bo", "Cy")
    assert found.winner.tolist() == from_file.winner.tolist() == [1, 2]


# One vocabulary for files and DataFrames: nothing in it is out of reach.


def test_every_word_is_written_as_it_is_compared():
    words = [*FORFEIT_WORDS, *FORMAT_WORDS]
    assert [letters(word) for word in words] == words


def test_every_format_has_a_word():
    assert {FORMATS[code] for code in FORMAT_WORDS.values()} == set(FORMATS) - {""}
