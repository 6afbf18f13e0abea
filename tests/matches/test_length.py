import pickle
from fractions import Fraction
from typing import Any

import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import AccuracyError, GameError, InputError
from evenbreak.games import (
    BREAK_FORMATS,
    CATALOG,
    Ahead,
    Match,
    OneBall,
    Race,
    Rack,
    Series,
    alternate_breaks,
    player_1_breaks,
    winner_breaks,
)
from evenbreak.matches import game_odds, match_length, match_odds, win_probability


def test_an_even_race_two_two() -> None:
    length = match_length(Race(2, 2, Rack(0.5)))
    assert length.games.tolist() == [2, 3]
    assert length.probability.tolist() == [0.5, 0.5]
    assert (length.mean, length.sd, length.p_never_ends, length.tail_mass) == (2.5, 0.5, 0.0, 0.0)
    assert length.bounded
    assert length.span == 3


def test_a_quantile_at_a_tie_is_the_smaller_length() -> None:
    assert match_length(Race(2, 2, Rack(0.5))).quantile(0.5) == 2
    # P(three racks) = .1^3 + .9^3 = .73, which floats miss: a level of .73 is reached there.
    assert match_length(Race(3, 3, Rack(0.1))).quantile(0.73) == 3
    assert match_length(Race(3, 3, Rack(0.1))).quantile(0.73 + 1e-9) == 4
    assert match_length(Race(3, 3, Rack(0.1))).quantile(1.0) == 5
    assert match_length(Race(3, 3, Rack(0.1))).quantile(0.0) == 3
    assert match_length(Race(3, 3, Rack(1.0))).quantile(1.0) == 3


@given(
    p1=st.floats(0.01, 0.99),
    p2=st.floats(0.01, 0.99),
    m=st.integers(1, 8),
    n=st.integers(1, 8),
    breaks=st.sampled_from(list(BREAK_FORMATS.values())),
    q=st.floats(0.0, 1.0),
)
def test_a_quantile_is_the_first_length_that_is_enough(
    p1: float, p2: float, m: int, n: int, breaks: Any, q: float
) -> None:
    length = match_length(Race(m, n, Rack(p1, p2), breaks=breaks))
    k = length.quantile(q)
    up_to = length.probability[length.games <= k].sum()
    before = length.probability[length.games < k].sum()
    assert up_to >= q - 1e-12
    assert before < q or k == min(m, n)


@given(p=st.floats(0.0, 1.0), lead=st.integers(1, 8))
def test_the_duration_of_an_n_ahead_match(p: float, lead: int) -> None:
    # Wald: the mean lead at the end is the mean length times the mean lead per rack.
    length = match_length(Ahead(lead, lead, Rack(p)), tail=1e-3)
    odds = match_odds(Ahead(lead, lead, Rack(p)))
    assert length.mean * (2 * p - 1) == pytest.approx(
        lead * (odds.p_win_1 - odds.p_win_2), rel=1e-12, abs=1e-12
    )
    assert length.mean >= lead * (1 - 1e-15)
    assert length.tail_mass <= 1e-3


def test_a_match_without_a_longest_length_says_what_it_leaves_out() -> None:
    # Two ahead of equals: each pair of racks ends the match with chance 1/2.
    length = match_length(Ahead(2, 2, Rack(0.5)), tail=0.01)
    assert length.games.tolist() == list(range(2, 15))
    assert length.probability[::2].tolist() == [0.5**k for k in range(1, 8)]
    assert not length.probability[1::2].any()
    assert length.tail_mass == 0.5**7
    assert length.mean == pytest.approx(4.0, rel=1e-15)
    assert length.sd == pytest.approx(8.0**0.5, rel=1e-15)
    assert not length.bounded
    assert length.quantile(0.75) == 4
    assert length.quantile(1.0) is None
    with pytest.raises(AccuracyError, match=r"the 0.995 quantile lies beyond 14 racks"):
        length.quantile(0.995)


def test_mean_and_spread_do_not_lose_digits_where_the_match_is_nearly_certain() -> None:
    q = 1e-12
    length = match_length(Ahead(5, 5, Rack(1.0 - 1e-12)))
    assert length.mean == pytest.approx(5 / (1 - 2 * q), rel=1e-14)
    assert length.sd == pytest.approx((4 * q * (1 - q) * 5 / (1 - 2 * q) ** 3) ** 0.5, rel=1e-10)


def test_a_match_that_may_never_end() -> None:
    length = match_length(Ahead(2, 2, Rack(1.0, 1.0), breaks=alternate_breaks))
    assert length.mean is None
    assert length.sd is None
    assert length.p_never_ends == 1.0
    assert length.quantile(0.5) is None
    sometimes = match_length(Ahead(2, 2, Rack(1.0, [1.0, 0.5]), breaks=alternate_breaks))
    assert sometimes.p_never_ends.tolist() == [1.0, 0.0]
    assert np.isnan(sometimes.mean[0])
    assert np.isnan(sometimes.sd[0])
    assert sometimes.mean[1] == pytest.approx(4.0)
    assert np.isnan(sometimes.quantile(0.5)[0])
    assert sometimes.quantile(0.5)[1] == 2


def test_a_set_that_never_ends_is_a_match_that_never_ends() -> None:
    endless = Ahead(2, 2, Rack(1.0, [1.0, 0.5]), breaks=alternate_breaks)
    length = match_length(Race(2, 2, endless, breaks=player_1_breaks))
    assert length.p_never_ends.tolist() == [1.0, 0.0]
    assert length.mean[1] == pytest.approx(8.0)


def test_arrays() -> None:
    p1, p2 = np.array([0.2, 0.5, 0.9]), np.array([[0.4], [0.7]])
    for match_of in (
        lambda rack: Race(4, 3, rack, breaks=winner_breaks),
        lambda rack: Race(4, 3, rack, breaks=player_1_breaks, win_by=2),
        lambda rack: Ahead(2, 3, rack, breaks=alternate_breaks),
        lambda rack: Race(2, 2, Race(2, 3, rack, breaks=alternate_breaks)),
    ):
        lengths = match_length(match_of(Rack(p1, p2)))
        assert lengths.probability.shape == (2, 3, len(lengths.games))
        for at in np.ndindex(2, 3):
            one = match_length(match_of(Rack(float(p1[at[1]]), float(p2[at[0], 0]))))
            shared = min(one.games.size, lengths.games.size)
            assert lengths.probability[at][:shared] == pytest.approx(
                one.probability[:shared], rel=1e-12, abs=0
            )
            assert lengths.mean[at] == pytest.approx(one.mean, rel=1e-13)
            assert lengths.sd[at] == pytest.approx(one.sd, rel=1e-13)
            assert lengths.quantile(0.9)[at] == one.quantile(0.9)
            assert lengths.tail_mass[at] <= 1e-12


def test_a_score_mid_match_and_a_decided_match() -> None:
    race = Race(7, 5, Rack(0.6), score=(1, 0))
    assert match_length(race, (6, 4)).probability.tolist() == [1.0]
    assert match_length(race, (6, 4)).games.tolist() == [1]
    over = match_length(race, (7, 4))
    assert (over.games.tolist(), over.probability.tolist(), over.mean) == ([0], [1.0], 0.0)
    over = match_length(Ahead(2, 2, Rack([0.5, 0.6])), (2, 0))
    assert over.probability.tolist() == [[1.0], [1.0]]
    assert over.bounded


def test_only_a_match_without_a_longest_length_is_cut_off(monkeypatch: Any) -> None:
    monkeypatch.setattr("evenbreak.matches.endings._LONGEST", 5)
    sets = match_length(Race(2, 2, Race(3, 3, Rack(0.5))))
    assert sets.span == 15
    assert sets.probability.sum() == pytest.approx(1.0, rel=1e-14)
    ahead = match_length(Ahead(2, 2, Rack(0.5)))
    assert (ahead.span, ahead.tail_mass) == (5, 0.25)
    assert ahead.mean == pytest.approx(4.0, rel=1e-14)


def test_a_set_that_is_over_is_no_set() -> None:
    with pytest.raises(InputError, match="a set that is already over"):
        Race(2, 2, Race(3, 2, Rack(0.5), score=(3, 1)))


def test_wrong_options_are_refused() -> None:
    with pytest.raises(InputError, match="tail must be a number from"):
        match_length(Race(2, 2, Rack(0.5)), tail=2)
    with pytest.raises(
        InputError, match=r"q must be one number from 0 to 1; you gave \[0\.5, 0\.9\]"
    ):
        match_length(Race(2, 2, Rack(0.5))).quantile([0.5, 0.9])  # type: ignore[arg-type]
    with pytest.raises(InputError, match=r"gave 1\.5"):
        match_length(Race(2, 2, Rack(0.5))).quantile(1.5)


# Who wins any game and when: against fractions, and against the kernels for matches.


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
    for name, game in CATALOG.items()
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
