"""A season goes night by night, and ratings with it."""

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import chart, system_of
from evenbreak.league.sandbag_watch import played_nights
from evenbreak.ratings.results import Results
from evenbreak.ratings.roster import Roster

NPL, TEN = system_of("npl"), chart("npl_10")
CLUB = Roster(["Ann", "Bo", "Cy"], [80, 80, 74])


def results(dates=None, **columns):
    given = {} if dates is None else {"date": np.array(dates, dtype="datetime64[D]")}
    return Results.from_names(
        ["Ann", "Bo", "Ann"], ["Bo", "Cy", "Cy"], [5, 5, 5], [3, 2, 1], **given, **columns
    )


def test_dates_make_nights_in_their_order():
    dates = ["2025-02-02", "2025-01-01", "2025-02-02"]
    nights = played_nights(NPL, CLUB, results(dates), chart=TEN)
    assert [night.rows.tolist() for night in nights] == [[1], [0, 2]]
    alone = played_nights(NPL, CLUB, results(), chart=TEN)
    assert [night.rows.tolist() for night in alone] == [[0], [1], [2]]


def test_ratings_of_a_night_are_those_before_it():
    nights = played_nights(
        NPL, CLUB, results(["2025-02-02", "2025-01-01", "2025-02-02"]), chart=TEN
    )
    assert nights[1].changes.before.rating.tolist() == [80, 81, 73]
    assert nights[1].changes.after.rating.tolist() == [82, 80, 72]


def test_without_dates_each_match_moves_the_next():
    nights = played_nights(NPL, CLUB, results(), chart=TEN)
    assert [night.changes.before.rating.tolist() for night in nights] == [
        [80, 80, 74],
        [81, 79, 74],
        [81, 80, 73],
    ]


def test_a_problem_has_its_row():
    with pytest.raises(InputError, match="row 1 of the results"):
        played_nights(NPL, CLUB, results(race_a=[5, 7, 5], race_b=[5, 7, 5]))
