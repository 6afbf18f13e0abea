"""Favourites in short races and in long ones."""

import numpy as np
import pytest

from evenbreak.ratings import Results, walk_forward
from evenbreak.ratings.validation.validate import race_lengths


def forecasts(races, *, longer=0):
    """Return forecasts of races that Ann, who has won before, wins but for the third."""
    many = len(races)
    race_b = np.array([5, *races])
    won = np.ones(many + 1, dtype=bool)
    won[3:4] = False
    race_a = race_b + longer
    results = Results.from_names(
        ["Ann"] * (many + 1), ["Bo"] * (many + 1), np.where(won, race_a, 0),
        np.where(won, 0, race_b), race_a=race_a, race_b=race_b,
        date=np.datetime64("2024-09-03") + np.arange(many + 1),
    )  # fmt: skip
    return walk_forward(results)


def test_the_halves_are_as_equal_as_lengths_allow():
    short, long = race_lengths(forecasts([3, 3, 4, 7, 7, 9]))
    assert (short.shortest, short.longest, short.matches, short.won) == (3, 4, 3, 2)
    assert (long.shortest, long.longest, long.matches, long.won) == (7, 9, 3, 3)
    assert short.share == pytest.approx(2 / 3)
    assert short.low < short.share < short.high
    assert 0.5 < short.predicted < long.predicted < 1


def test_one_length_and_handicaps_say_nothing():
    assert race_lengths(forecasts([5, 5, 5])) == []
    assert race_lengths(forecasts([3, 5, 7], longer=1)) == []
