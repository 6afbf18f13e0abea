"""When a figure is clearly off."""

import pytest

from evenbreak.answers.league.validate_handicaps import (
    clearly_off,
    points_text,
    scored_of,
    share_of,
    wrong_chances,
)
from evenbreak.ratings import scale_of
from evenbreak.ratings.estimates import Estimate


@pytest.mark.parametrize(
    ("low", "high", "off"),
    [
        (1.02, 1.5, 0),  # below 1% takes an interval wider by a third
        (1.2, 1.5, 1),
        (0.5, 0.8, -1),
        (0.5, 0.95, 0),
        (0.9, 1.1, 0),
    ],
)
def test_an_interval_of_99_percent_decides(low, high, off):
    assert clearly_off(Estimate((low + high) / 2, low, high), 1.0) == off


def test_the_default_prior_is_too_wide_for_players_who_are_alike(alike):
    assert wrong_chances(alike.usual, alike) == {"game": -1, "match": -1}
    assert wrong_chances(alike.scored, alike) == {}


def test_matches_under_handicaps_are_not_judged(demo):
    assert clearly_off(scored_of(demo, "match").slope, 1.0) == -1
    assert wrong_chances(demo.scored, demo) == {}


def test_what_the_demo_league_holds(demo):
    assert share_of(demo.spots[-1]).value == pytest.approx(186 / 351)
    assert points_text(0.52, scale_of("npl")) == "22.5"
