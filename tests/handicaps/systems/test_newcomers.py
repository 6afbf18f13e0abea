"""The factor of a newcomer's moves, by the matches played."""

import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps.systems.npl import NEWCOMER_STEPS, step_after


@pytest.mark.parametrize(("played", "factor"), [(0, 3), (9, 3), (10, 2), (29, 2), (30, 1)])
def test_the_leagues_schedule(played, factor):
    assert step_after(played) == factor
    assert sum(matches for matches, _ in NEWCOMER_STEPS) == 30


def test_an_established_player_and_a_system_without_newcomers():
    assert step_after(None) == 1
    assert step_after(0, ()) == 1


def test_matches_are_counted_from_0():
    with pytest.raises(InputError, match="played must be a whole number, 0 or more; you gave -1"):
        step_after(-1)
