"""Steps of any length, by hand."""

import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps.systems.by_match import PlayedMatch
from evenbreak.handicaps.systems.npl import NPL
from evenbreak.handicaps.systems.step import step_system


def test_steps_may_differ_between_winner_and_loser():
    match = PlayedMatch((80, 80), None, None)
    assert step_system(3).rule(match) == (3, -3)
    assert step_system(3, 0).rule(match) == (3, 0)
    assert step_system(2, 2) == step_system(2)
    assert step_system(1).in_words == NPL.in_words


@pytest.mark.parametrize(
    ("numbers", "message"),
    [
        ((0,), "up must"),
        ((1, -1), "down must be a whole number from 0 to 1000; you gave -1"),
        ((1001,), "up must be a whole number from 1 to 1000; you gave 1001"),
    ],
)
def test_numbers_out_of_reach_are_refused(numbers, message):
    with pytest.raises(InputError, match=message):
        step_system(*numbers)
