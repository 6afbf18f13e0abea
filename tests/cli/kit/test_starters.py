"""--starter and --starter-sd."""

import numpy as np
import pytest

from evenbreak.answers.kit.systems import with_starters
from evenbreak.fields.question import AskedError
from evenbreak.ratings import SCALES, Roster, scale_of

CLUB = Roster(["Ann", "Bo"], [600.0, np.nan], games=[100, 0])


def test_new_players_start_in_the_middle_or_as_stated():
    usual = with_starters(CLUB, SCALES["fargo"], None, None)
    assert (usual.rating[1], usual.standard_error[1]) == (500.0, 100.0)
    stated = with_starters(CLUB, SCALES["fargo"], 420.0, 60.0)
    assert (stated.rating[1], stated.standard_error[1]) == (420.0, 60.0)


def test_a_scale_without_a_middle_needs_a_starter():
    with pytest.raises(AskedError, match="starter"):
        with_starters(CLUB, scale_of(70), None, None)
    with pytest.raises(AskedError, match="starter_sd"):
        with_starters(CLUB, SCALES["fargo"], None, 1e5)
