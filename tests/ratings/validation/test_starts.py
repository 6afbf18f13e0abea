"""What starts take back, in leagues that give too little, enough and too much."""

import dataclasses

import numpy as np
import pytest

from evenbreak.ratings import Results
from evenbreak.ratings.handicap_slope import handicap_slope
from evenbreak.ratings.levels import implied_difference
from evenbreak.ratings.validation.starts import class_steps, even_start, starts
from handicapped import by_chart, by_class


def test_a_class_has_its_worth_and_a_start_takes_back_less():
    found = starts(by_class(1))
    assert found.classes == ("D", "C", "B", "A")
    assert found.a_class.low < 0.5 < found.a_class.high
    assert found.share.low > 2.0
    one = found.groups[0]
    assert (one.apart, one.race) == (1, (7, 6))
    assert one.taken == pytest.approx(0.162, abs=0.001)
    assert one.stronger.low < 0.5 < one.stronger.high


@pytest.mark.parametrize(("start", "way"), [(1, 1), (3, -1)])
def test_without_classes_starts_are_judged_by_the_games_given(start, way):
    found = starts(by_class(2, named=False, worth=0.45, start=start, matches=600))
    assert (found.classes, found.a_class) == ((), None)
    assert [one.apart for one in found.groups] == [start, 2 * start][: len(found.groups)] or way > 0
    assert np.sign(found.stronger.value - found.taken) == way
    assert found.share.low > 1.0 if way > 0 else found.share.high < 1.0


def test_right_starts_are_not_called_wrong():
    # NPL chart 10 gives a little too little beyond 57 points, its last row.
    shares = [starts(by_chart(seed, levels=False, matches=400)).share for seed in range(10)]
    assert sum(not one.low < 1.05 < one.high for one in shares) <= 2


def test_numbers_are_classes_by_their_value():
    season = by_class(3, matches=200)
    number = {"D": "2", "C": "3", "B": "5", "A": "6"}
    levels = {
        name: np.array([number[text] for text in getattr(season, name)], dtype=object)
        for name in ("level_a", "level_b")
    }
    names, above = class_steps(dataclasses.replace(season, **levels), implied_difference(season))
    assert names == ("2", "3", "5", "6")
    assert set(np.abs(above).tolist()) == {0.0, 1.0, 2.0, 3.0, 4.0}


def test_the_nearest_start_is_found():
    assert [even_start(7, d) for d in (0.0, 0.16, 0.35, 2.0)] == [7, 6, 5, 1]


def test_few_handicap_matches_say_nothing():
    assert starts(by_class(4, matches=100)) is None


# The slope of strength in what a league says, in simulated leagues.


WORTH = {"D": 0, "C": 1, "B": 2, "A": 3}


def steps(season):
    return np.array(
        [
            float(WORTH[a] - WORTH[b])
            for a, b in zip(season.level_a, season.level_b, strict=True)
        ]
    )  # fmt: skip


def test_intervals_hold_the_truth():
    held, values = 0, []
    for seed in range(40):
        season = by_class(seed, matches=300)
        found = handicap_slope(season, steps(season))
        held += found.low < 0.5 < found.high
        values.append(found.value)
    assert held >= 34
    assert np.mean(values) == pytest.approx(0.5, abs=3 * np.std(values) / 40**0.5)


def test_units_do_not_matter():
    season = by_class(1, matches=300)
    one, ten = (handicap_slope(season, unit * steps(season)) for unit in (1.0, 10.0))
    assert np.array(one) == pytest.approx(10.0 * np.array(ten), rel=1e-5)


def test_what_does_not_determine_a_slope_has_none():
    season = Results.from_names(["Ann"] * 3, ["Bo"] * 3, [7, 7, 7], [0, 0, 0])
    assert handicap_slope(season, np.zeros(3)) is None
