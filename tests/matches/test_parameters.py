import numpy as np
import pytest

from evenbreak.errors import GameError, InputError
from evenbreak.games import Ahead, OneBall, Race, Rack, alternate_breaks
from evenbreak.matches import (
    final_scores,
    game_odds,
    hill_hill_probability,
    live_odds,
    match_odds,
    win_probability,
)
from evenbreak.matches.parameters import (
    at_score,
    checked_match,
    ends_of_game,
    first_breaker,
    in_shape,
    rack_of_game,
    with_rack,
)

SETS = Race(3, 1, Race(3, 3, Rack(0.6, 0.5), breaks=alternate_breaks), first_breaker=2)


def test_other_games_are_refused():
    assert checked_match(SETS) is SETS
    with pytest.raises(InputError, match="OneBall"):
        checked_match(OneBall(0.5, 0.5))


def test_the_innermost_rack_is_replaced():
    changed = with_rack(SETS, Rack(0.1, 0.2))
    assert changed.innermost_rack == Rack(0.1, 0.2)
    assert (changed.m, changed.rack.m, changed.first_breaker) == (3, 3, 2)


def test_the_first_breaker_in_states():
    assert first_breaker(SETS) == 2
    assert first_breaker(Race(3, 3, Rack(0.6), first_breaker=2)) == 1


def test_p1_and_p2_get_one_shape():
    match, shape = at_score(with_rack(SETS, Rack([0.1, 0.2, 0.3], 0.5)), None)
    assert shape == match.innermost_rack.p2.shape == (3,)
    assert at_score(SETS, None) == (SETS, ())


def test_a_score_replaces_that_of_the_match():
    match, _ = at_score(SETS, (1, 0))
    assert match.score == (1, 0)
    with pytest.raises(InputError, match="4-0"):
        at_score(SETS, (4, 0))


def test_an_answer_gets_the_shape_of_the_parameters():
    assert in_shape(np.float64(0.5), ()) == 0.5
    assert isinstance(in_shape(np.float64(0.5), ()), float)
    assert in_shape(0.5, (2, 2)).tolist() == [[0.5, 0.5], [0.5, 0.5]]


# Own games as racks: their chances, and which games cannot be one.


class Ends:
    """One move to each of the ends given, by winner."""

    start = "play"

    def __init__(self, chances):
        self.chances = chances

    def moves(self, state):
        return dict(self.chances) if state == "play" else {}

    def winner(self, state):
        return state if isinstance(state, int) else None


def test_final_states_are_listed_by_winner():
    assert ends_of_game(Ends({1: 0.5, 2: 0.25, "draw": 0.25})).by_winner == {
        1: [1],
        2: [2],
        None: ["draw"],
    }


def test_a_rack_has_the_chance_of_the_game():
    assert rack_of_game(OneBall(0.5, 0.25)).p1 == pytest.approx(0.8, rel=1e-15)


@pytest.mark.parametrize(
    ("chances", "named"),
    [
        ({1: 0.5, 2: 0.25, 3: 0.25}, "player 3"),
        ({1: 0.5, 2: 0.25, "draw": 0.25}, "probability 0.25"),
        ({1: 0.5, "play": 0.5, 2: 0.0}, None),
        ({"play": 1.0}, "probability 1"),
    ],
)
def test_a_rack_has_two_players_one_of_whom_wins(chances, named):
    if named is None:
        assert rack_of_game(Ends(chances)) == Rack(1.0)
        return
    with pytest.raises(GameError, match=named):
        rack_of_game(Ends(chances))


@pytest.mark.parametrize("after", [{1: 1.0}, {2: 1.0}, {"play": 0.5, 2: 0.5}])
def test_nobody_may_have_won_while_the_game_goes_on(after):
    """A final state that moves to itself would otherwise never end, and its winner never win."""
    game = Ends({1: 0.6, 2: 0.4})
    game.moves = lambda state: {"play": {1: 0.6, 2: 0.4}, 1: after}.get(state, {})
    for ask in (game_odds, win_probability, rack_of_game):
        with pytest.raises(GameError, match="player 1 has won in 1"):
            ask(game)


def test_a_small_chance_keeps_its_digits():
    rack = rack_of_game(Ends({1: 1.0 - 1e-14, 2: 1e-14}))
    assert rack.chance(2) == pytest.approx(1e-14, rel=1e-12)


def test_every_kernel_takes_a_match_of_own_games():
    game = OneBall(0.5, 0.25)  # player 1 wins it with 0.8
    for own, same in (
        (Race(3, 2, game), Race(3, 2, Rack(0.8))),
        (Ahead(2, 3, game), Ahead(2, 3, Rack(0.8))),
        (Race(2, 1, Race(2, 2, game)), Race(2, 1, Race(2, 2, Rack(0.8)))),
    ):
        for found, expected in zip(match_odds(own), match_odds(same), strict=True):
            assert found == (expected and pytest.approx(expected, rel=1e-12))
        assert live_odds(own, [1]).now.p_win_1 == pytest.approx(live_odds(same, [1]).now.p_win_1)
        assert final_scores(own).probability == pytest.approx(final_scores(same).probability)
    race = Race(3, 3, game)
    assert hill_hill_probability(race) == pytest.approx(6 * 0.8**2 * 0.2**2)
