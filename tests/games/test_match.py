"""What races and n-ahead matches share: scores, states, breakers, sets."""

import pytest

from evenbreak.errors import GameError, InputError
from evenbreak.games import Ahead, Match, OneBall, Race, Rack, alternate_breaks, winner_breaks

BROKEN = Rack(0.6, 0.5)


def test_states_hold_the_breaker_only_where_the_break_matters():
    assert Race(3, 3, Rack(0.6)).start == (0, 0)
    assert Race(3, 3, BROKEN, breaks=winner_breaks, first_breaker=2).start == (0, 0, 2)


def test_the_state_of_a_set_is_inside_that_of_the_match():
    inner = Race(2, 2, BROKEN, breaks=winner_breaks)
    assert Race(3, 3, inner).start == (0, 0, (0, 0, 1))
    # With its own break format the match keeps who broke first in the set.
    assert Race(3, 3, inner, breaks=alternate_breaks).start == (0, 0, 1, (0, 0, 1))


def test_a_set_that_ends_counts_one_and_passes_the_break_on():
    inner = Race(1, 1, BROKEN, breaks=winner_breaks)
    carried = Race(2, 2, inner).moves((0, 0, (0, 0, 1)))
    assert carried == {(1, 0, (0, 0, 1)): 0.6, (0, 1, (0, 0, 2)): 0.4}
    alternating = Race(2, 2, inner, breaks=alternate_breaks)
    assert set(alternating.moves(alternating.start)) == {(1, 0, 2, (0, 0, 2)), (0, 1, 2, (0, 0, 2))}


def test_a_finished_match_knows_who_would_break_next():
    race = Race(1, 1, BROKEN, breaks=alternate_breaks)
    assert [race.next_breaker(state) for state in race.moves(race.start)] == [2, 2]
    assert Race(1, 1, Rack(0.5)).next_breaker((1, 0)) == 1


class Over:
    """A game that three players have already played."""

    start = 3

    def moves(self, state):
        return {} if state else {3: 1.0}

    def winner(self, state):
        return state or None

    def label(self, state):
        return f"player {state}"


def test_a_game_of_ones_own_is_played_inside_the_match():
    race = Race(2, 1, OneBall(0.5, 0.25))
    assert race.start == (0, 0, "S1")
    assert race.moves(race.start) == {(1, 0, "S1"): 0.5, (0, 0, "S2"): 0.5}
    assert race.moves((1, 0, "S2")) == {(1, 1): 0.25, (1, 0, "S1"): 0.75}
    assert race.label((1, 0, "S2")) == "1:0\nS2"
    assert race.innermost_rack == OneBall(0.5, 0.25)
    assert not race.break_matters


def test_only_players_1_and_2_win_racks():
    game = Over()
    game.start = 0
    with pytest.raises(GameError, match="winner is 3"):
        Race(2, 1, game).moves((0, 0, 0))
    assert Race(2, 1, game).label((1, 0, 0)) == "1:0\nplayer 0"


def test_sets_of_sets_have_one_innermost_rack():
    deep = Race(2, 2, Ahead(2, 2, Race(3, 3, BROKEN, breaks=winner_breaks)))
    assert deep.innermost_rack is BROKEN
    assert deep.break_matters


@pytest.mark.parametrize("score", [(3, 3), (4, 0), (3, -1), (2,), "12x"])
def test_a_score_must_be_reachable(score):
    with pytest.raises(InputError, match="score"):
        Race(3, 3, Rack(0.5), score=score)


@pytest.mark.parametrize(
    ("make", "named"),
    [
        (lambda: Race(3, 3, BROKEN), "breaks is missing"),
        (
            lambda: Race(3, 3, 0.5),
            (
                r"rack must be a Rack\(p\), a Rack\(p1, p2\), a match, or a game with start, "
                r"moves and winner; you gave 0\.5"
            ),
        ),
        (lambda: Race(3, 3, Race(2, 2, Rack(0.5), score=(2, 0))), "rack is a set"),
        (lambda: Ahead(3, 0, Rack(0.5)), "n must be a whole number, 1 or more; you gave 0"),
        (lambda: Race(3, 3, OneBall(0.5, 0.5), breaks=winner_breaks), "breaks and first_breaker"),
        (lambda: Race(3, 3, OneBall(0.5, 0.5), first_breaker=2), "breaks and first_breaker"),
        (lambda: Race(3, 3, Over()), "over before it starts"),
        (
            lambda: Ahead(3, 3, BROKEN, breaks="winner"),
            "breaks must be a break format such as winner_breaks; you gave 'winner'",
        ),
        (lambda: Race(3, 3, Rack(0.5), first_breaker=0), "first_breaker must"),
    ],
)
def test_wrong_values_are_named(make, named):
    with pytest.raises(InputError, match=named):
        make()


def test_a_match_alone_is_abstract():
    with pytest.raises(TypeError):
        Match(3, 3, Rack(0.5))
