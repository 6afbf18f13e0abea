"""Who wins any game and when: against fractions, and against the kernels for matches."""

import pickle
from fractions import Fraction

import networkx as nx
import numpy as np
import pytest

from evenbreak.errors import GameError, InputError
from evenbreak.games import CATALOGUE, Match, OneBall, Race, Rack, Series, player_1_breaks
from evenbreak.matches import game_odds, match_length, win_probability

P = (Fraction(1, 2), Fraction(1, 3), Fraction(1, 5))


class InTurn:
    """Any number of players shoot at one ball, up to a limit of shots, after which nobody wins."""

    def __init__(self, chances, limit=None):
        self.chances, self.limit, self.start = chances, limit, 0

    def moves(self, shot):
        if isinstance(shot, str) or shot == self.limit:
            return {}
        turn = shot % len(self.chances)
        made = float(self.chances[turn])
        after = shot + 1 if self.limit else (turn + 1) % len(self.chances)
        return {f"won by {turn + 1}": made, after: 1.0 - made}

    def winner(self, shot):
        return int(shot.split()[-1]) if isinstance(shot, str) else None


def misses(shots):
    left = Fraction(1)
    for shot in range(shots):
        left *= 1 - P[shot % 3]
    return left


def test_three_players_in_turn_have_the_chances_of_the_geometric_series():
    odds = game_odds(InTurn(P))
    round_goes_on = misses(3)
    for player in (1, 2, 3):
        exact = misses(player - 1) * P[player - 1] / (1 - round_goes_on)
        assert odds.p_win[player] == pytest.approx(float(exact), rel=1e-14)
    mean = sum(misses(k) for k in range(3)) / (1 - round_goes_on)
    assert odds.length.mean == pytest.approx(float(mean), rel=1e-14)
    assert (odds.p_no_winner, odds.p_never_ends) == (0.0, 0.0)
    assert not odds.length.bounded


def test_when_each_player_wins_is_exact():
    odds = game_odds(InTurn(P))
    frame = odds.to_frame()
    for moves in range(1, 30):
        player = (moves - 1) % 3 + 1
        exact = misses(moves - 1) * P[player - 1]
        assert frame.loc[moves, player] == pytest.approx(float(exact), rel=1e-13)
    np.testing.assert_allclose(frame.sum(axis=1), odds.length.probability, rtol=1e-15)
    assert odds.length.quantile(0.5) == 1
    assert odds.length.quantile(0.9) == 5


def test_a_game_may_end_without_a_winner_and_has_a_longest_length():
    odds = game_odds(InTurn(P, limit=7))
    assert odds.p_no_winner == pytest.approx(float(misses(7)), rel=1e-14)
    assert odds.length.bounded
    assert odds.length.span == 7
    assert odds.length.tail_mass == 0.0
    assert odds.to_series().sum() == pytest.approx(1.0, abs=1e-15)


def test_an_endless_game_never_ends():
    odds = game_odds(Series(Rack(0.6, 0.5), breaks=player_1_breaks))
    assert (dict(odds.p_win), odds.p_never_ends, odds.length.mean) == ({}, 1.0, None)
    assert odds.length.quantile(0.5) is None


def test_it_begins_in_the_state_given():
    assert game_odds(InTurn(P), "won by 2").p_win == {2: 1.0}
    assert game_odds(InTurn(P), "won by 2").length.games.tolist() == [0]
    assert win_probability(InTurn(P), 2, player=3) == game_odds(InTurn(P), 2).p_win[3]


def test_a_graph_with_winners_is_a_game():
    graph = nx.DiGraph()
    graph.add_edge("play", "won", probability=0.25)
    graph.add_edge("play", "drawn", probability=0.75)
    graph.nodes["won"]["winner"] = 1
    odds = game_odds(graph, "play")
    assert (dict(odds.p_win), odds.p_no_winner) == ({1: 0.25}, 0.75)


RACKS = {
    name: game
    for name, game in CATALOGUE.items()
    if isinstance(game, Match) and isinstance(game.rack, Rack)
}


@pytest.mark.parametrize("match", RACKS.values(), ids=list(RACKS))
def test_matches_of_racks_have_the_odds_of_their_kernels(match):
    odds, length = game_odds(match), match_length(match)
    for player in (1, 2):
        assert odds.p_win[player] == pytest.approx(win_probability(match, player=player), 1e-12)
    assert odds.length.mean == pytest.approx(length.mean, rel=1e-12)
    assert odds.length.sd == pytest.approx(length.sd, rel=1e-12)
    assert odds.length.bounded == length.bounded
    shared = min(odds.length.probability.size, length.probability.size)
    np.testing.assert_allclose(
        odds.length.probability[:shared], length.probability[:shared], rtol=1e-10, atol=1e-15
    )


def test_the_length_of_an_own_game_is_that_of_its_odds():
    game = InTurn(P)
    assert match_length(game).mean == game_odds(game).length.mean
    assert win_probability(game, player=9) == 0.0


@pytest.mark.parametrize("winner", [0, "Ann", 1.5])
def test_a_winner_is_the_number_of_a_player(winner):
    class Wrong(InTurn):
        def winner(self, shot):
            return winner if isinstance(shot, str) else None

    with pytest.raises(GameError, match="winner"):
        game_odds(Wrong(P))


@pytest.mark.parametrize("wrong", [Rack(0.5), 5, [(0, 1, 0.5)]])
def test_what_is_not_a_game_is_refused(wrong):
    with pytest.raises(InputError, match="game"):
        game_odds(wrong)
    with pytest.raises(InputError):
        win_probability(wrong)
    with pytest.raises(InputError):
        match_length(wrong)


def test_odds_can_be_sent_to_another_process():
    odds = game_odds(OneBall(0.4, 0.8))
    sent = pickle.loads(pickle.dumps(odds))  # noqa: S301
    assert sent.p_win == odds.p_win
    assert sent.to_frame().equals(odds.to_frame())


def test_the_repr_is_short():
    assert repr(game_odds(OneBall(0.5, 0.25))) == "<GameOdds: player 1 wins 0.8, player 2 wins 0.2>"


def test_an_own_game_is_the_rack_of_a_race():
    p = win_probability(OneBall(0.4, 0.8))
    own, same = Race(5, 4, OneBall(0.4, 0.8)), Race(5, 4, Rack(p))
    assert win_probability(own) == pytest.approx(win_probability(same), rel=1e-14)
    assert game_odds(own).p_win[1] == pytest.approx(win_probability(same), rel=1e-12)
    assert match_length(own).mean == pytest.approx(match_length(same).mean, rel=1e-12)
    # In shots it takes longer: each one-ball game is several moves.
    assert game_odds(own).length.mean > match_length(own).mean
