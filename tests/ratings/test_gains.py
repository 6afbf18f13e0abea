"""When one way of rating clearly predicts better than another."""

import numpy as np

from evenbreak.ratings.prior import FEWEST_STRETCHES, gains_over, is_clear
from evenbreak.ratings.stretches import StretchLosses

MANY = 25


def losses(saved):
    """Return the losses of two ways, the second of which saves so much in each stretch."""
    return StretchLosses(
        np.column_stack([np.full(len(saved), 50.0), 50.0 - saved]), np.full(len(saved), 70.0)
    )


def test_a_gain_is_what_is_saved_a_game():
    (gain,) = gains_over(losses(np.full(MANY, 0.7)))
    assert round(gain.value, 9) == 0.01
    assert gain.low == gain.high


def test_a_steady_gain_is_clear_however_small_and_luck_is_not():
    rng = np.random.default_rng(1)
    assert is_clear(losses(np.full(MANY, 0.01)))
    assert not is_clear(losses(rng.normal(0.0, 0.5, MANY)))


def test_much_gained_early_in_the_season_is_clear():
    saved = np.zeros(MANY)
    saved[:4] = 2.0
    assert is_clear(losses(saved))
    assert not is_clear(losses(saved / 4))


def test_a_few_stretches_show_nothing():
    assert not is_clear(losses(np.full(FEWEST_STRETCHES - 1, 5.0)))
