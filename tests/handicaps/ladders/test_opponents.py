import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import (
    AUTOCORRELATED,
    EQUAL_SKILL,
    NATURAL,
    Ladder,
    Opponents,
    chart,
    opponents_of,
)
from evenbreak.stats import Distribution


def test_the_three_models():
    assert NATURAL.error == Distribution((0,), (1.0,))
    assert (AUTOCORRELATED.given, EQUAL_SKILL.given) == ("rating", "skill")
    assert AUTOCORRELATED.error is EQUAL_SKILL.error is None


def test_a_league_offers_each_of_its_ratings_alike():
    found = opponents_of([71, 80, 80, 95], 80)
    assert found.spread.values == (-9, 0, 15)
    assert [float(x) for x in found.spread.probability] == [0.25, 0.5, 0.25]
    assert (found.given, found.farthest) == ("rating", 15)


def test_ratings_are_rounded_before_they_are_subtracted():
    assert opponents_of([80.4], 79.6).spread.values == (0,)
    assert opponents_of([80.6], 79.4).spread.values == (2,)


def test_a_league_of_equals_is_the_model_that_it_looks_like():
    law = Ladder(chart("npl_8"), opponents=opponents_of([80, 80], 80)).law()
    assert law == Ladder(chart("npl_8"), opponents=AUTOCORRELATED).law()
    law = Ladder(chart("npl_8"), opponents=opponents_of([80], 80, given="skill")).law()
    assert law == Ladder(chart("npl_8"), opponents=EQUAL_SKILL).law()


def test_meeting_only_better_rated_players_shifts_the_players_error_alone():
    league = opponents_of(np.arange(100, 140), 80)
    found = Ladder(chart("npl_10"), opponents=league)
    assert found.law().mean != pytest.approx(0.0, abs=0.1)
    mean = np.array(found.opponent_law.probability) @ found.errors
    assert mean == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"given": "class"}, "given must be 'skill' or 'rating'; you gave 'class'"),
        ({"spread": (0, 1)}, "spread must be a Distribution of whole points"),
        (
            {"spread": Distribution((0.5,), (1.0,))},
            r"spread must have whole numbers of points; one value is 0\.5",
        ),
        (
            {"error": Distribution((0, 1.25), (0.5, 0.5))},
            r"error must have whole numbers of points; one value is 1\.25",
        ),
    ],
)
def test_what_makes_no_opponents_is_refused(change, message):
    with pytest.raises(InputError, match=message):
        Opponents(**change)


@pytest.mark.parametrize(
    ("ratings", "message"),
    [
        ([], "ratings must not be empty"),
        ([80, float("nan")], "ratings must be finite numbers; it holds nan"),
        (["x"], "ratings must be a finite number; it is"),
    ],
)
def test_ratings_that_are_none_are_refused(ratings, message):
    with pytest.raises(InputError, match=message):
        opponents_of(ratings, 80)
