"""--discipline or --minutes-per-game."""

import pytest

from evenbreak.answers.kit.systems import stated_pace
from evenbreak.fields.question import AskedError
from evenbreak.matches import PACES, own_pace
from evenbreak.tournaments.evening.format import DISCIPLINES


def test_every_pace_can_be_named():
    assert tuple(PACES) == DISCIPLINES


def test_one_of_the_two_says_how_fast():
    assert stated_pace(None, None) is None
    assert stated_pace("8-ball", None) == "8-ball"
    assert stated_pace(None, 7.5) == own_pace(7.5)
    with pytest.raises(AskedError, match="minutes_per_game"):
        stated_pace("8-ball", 7.5)
