"""The slope of strength in what a league says, in simulated leagues."""

import numpy as np
import pytest

from evenbreak.ratings import Results
from evenbreak.ratings.validation.starts import handicap_slope
from handicapped import by_class

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
