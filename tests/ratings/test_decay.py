import datetime as dt
import math

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.ratings import Results, fit
from evenbreak.ratings.decay import day_of, match_weights


def season(dates, scores=((7, 3), (2, 7), (7, 6))):
    won, lost = zip(*scores, strict=True)
    return Results.from_names(["A"] * len(won), ["B"] * len(won), won, lost, date=dates)


DATES = ["2026-01-01", "2026-01-11", "2026-01-31"]


def test_weights_halve():
    np.testing.assert_allclose(match_weights(season(DATES), 10), [1 / 8, 1 / 4, 1])
    later = match_weights(season(DATES), 10, day_of("2026-02-10"))
    np.testing.assert_allclose(later, [1 / 16, 1 / 8, 1 / 2])


def test_a_match_of_weight_one_half_counts_as_half_its_games():
    old = fit(season(DATES[:2], ((8, 2), (2, 6))), half_life=10)
    halved = fit(season(DATES[:2], ((4, 1), (2, 6))))
    np.testing.assert_allclose(old.rating, halved.rating, atol=1e-8)
    np.testing.assert_allclose(old.standard_error, halved.standard_error, rtol=1e-10)
    assert (old.games.tolist(), old.half_life) == ([18, 18], 10.0)


def test_without_age_decay_changes_nothing():
    plain, decayed = fit(season([DATES[0]] * 3)), fit(season([DATES[0]] * 3), half_life=1)
    np.testing.assert_allclose(decayed.rating, plain.rating, atol=1e-8)


def test_a_day_of_old_uses_what_was_known_then():
    then = fit(season(DATES), half_life=30, as_of="2026-01-20")
    known = fit(season(DATES[:2], ((7, 3), (2, 7))), half_life=30, as_of="2026-01-20")
    assert (then.rating == known.rating).all()
    assert (then.later, then.matches, known.later) == (1, 2, 0)


def test_very_old_matches_are_worth_nothing_and_do_no_harm():
    ratings = fit(season(["0001-01-01"] * 3), half_life=0.5, as_of="2026-01-01")
    assert ratings.rating == pytest.approx([80, 80], abs=1e-6)
    assert ratings.standard_error == pytest.approx([30, 30])


def test_days():
    for written in ("2026-01-31", dt.date(2026, 1, 31), np.datetime64("2026-01-31")):
        assert day_of(written) == np.datetime64("2026-01-31")


@pytest.mark.parametrize("day", ["soon", "", None, "2026-02-30", 3.5])
def test_other_days_are_refused(day):
    with pytest.raises(InputError, match="such as 2026-01-31"):
        day_of(day)


@pytest.mark.parametrize("half_life", [0, -1, math.nan, math.inf, "long"])
def test_half_lives_are_positive(half_life):
    with pytest.raises(InputError, match="half_life"):
        fit(season(DATES), half_life=half_life)


def test_dates_are_asked_for_where_they_are_needed():
    undated = Results.from_names(["A", "A"], ["B", "B"], [7, 7], [5, 5])
    with pytest.raises(InputError, match="2 of 2 matches have no date"):
        fit(undated, half_life=10)
    half = Results.from_names(["A", "A"], ["B", "B"], [7, 7], [5, 5], date=["2026-01-01", "NaT"])
    with pytest.raises(InputError, match="1 of 2 matches have no date"):
        fit(half, as_of="2026-01-01")
