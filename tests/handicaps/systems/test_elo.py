"""Elo's update, by hand."""

import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps.systems.by_match import PlayedMatch
from evenbreak.handicaps.systems.elo import elo_system


def test_a_winner_may_lose_points_by_elos_update():
    rule = elo_system(16).rule
    # A doubling of the odds: 2 of 3 games are expected, 6 of 9.
    doubling = 400 * 0.30102999566398120
    assert rule(PlayedMatch((doubling, 0.0), (6, 3), None)) == (0, 0)
    assert rule(PlayedMatch((doubling, 0.0), (5, 4), None)) == (-16, 16)
    assert rule(PlayedMatch((0.0, doubling), (5, 4), None)) == (32, -32)


def test_k_is_a_whole_number():
    with pytest.raises(InputError, match="gave 'x'"):
        elo_system("x")


def test_the_score_is_needed():
    with pytest.raises(InputError, match="score"):
        elo_system().rule(PlayedMatch((1500, 1500), None, None))
