"""The National Pool League's rule, by hand."""

from evenbreak.handicaps.systems.by_match import PlayedMatch
from evenbreak.handicaps.systems.npl import NPL


def test_the_pool_league_moves_a_point_a_match_whatever_the_match_was():
    rule = NPL.rule
    assert rule(PlayedMatch((40.0, 130.0), (2, 6), (2, 7))) == (1, -1)
    assert rule(PlayedMatch((130.0, 40.0), None, None)) == (1, -1)


def test_newcomers_of_the_pool_league_move_by_three_then_by_two():
    rule = NPL.rule
    moves = [rule(PlayedMatch((80, 80), None, None, (n, None))) for n in (0, 9, 10, 29, 30)]
    assert moves == [(3, -1), (3, -1), (2, -1), (2, -1), (1, -1)]
    assert rule(PlayedMatch((80, 80), None, None, (40, 5))) == (1, -3)
