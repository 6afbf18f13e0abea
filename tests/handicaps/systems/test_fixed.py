"""Matches of one length."""

import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps.systems.npl import NPL
from evenbreak.handicaps.systems.step import fixed_length_system


def test_fixed_length_matches_are_the_pool_leagues_but_for_the_chart():
    nine, npl = fixed_length_system(), NPL
    assert nine.name == "fixed 9"
    assert (nine.rule, nine.scale, nine.newcomer_steps) == (npl.rule, npl.scale, npl.newcomer_steps)
    assert {sum(row[2:]) for row in nine.usual_chart().rows} == {10}


@pytest.mark.parametrize(
    ("games", "message"),
    [(8, "7 or 9"), (1001, "games must be a whole number from 1 to 999; you gave 1001")],
)
def test_lengths_are_odd_and_not_too_long(games, message):
    with pytest.raises(InputError, match=message):
        fixed_length_system(games)
