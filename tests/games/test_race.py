from itertools import product
from math import comb

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.chains import chain_of, stochastic_limit
from evenbreak.errors import InputError
from evenbreak.game import arcs_of
from evenbreak.games import BREAK_FORMATS, Race, Rack, alternate_breaks, winner_breaks
from rows import each_of


def chance(race: Race, player: int = 1) -> float:
    limit = stochastic_limit(chain_of(race)).to_dict()
    return sum(p for state, p in limit.items() if race.winner(state) == player)


def test_the_states_of_a_short_race() -> None:
    race = Race(2, 1, Rack(0.75))
    assert race.start == (0, 0)
    assert race.moves((0, 0)) == {(1, 0): 0.75, (0, 1): 0.25}
    assert race.moves((1, 0)) == {(2, 0): 0.75, (1, 1): 0.25}
    assert [race.moves(state) for state in ((2, 0), (1, 1), (0, 1))] == [{}, {}, {}]
    assert [race.winner(s) for s in ((0, 0), (1, 0), (2, 0), (0, 1), (1, 1))] == [
        None,
        None,
        1,
        2,
        2,
    ]


def test_the_breaker_is_part_of_the_state_where_it_matters() -> None:
    race = Race(2, 2, Rack(0.75, 0.5), breaks=winner_breaks)
    assert race.start == (0, 0, 1)
    assert race.moves((0, 0, 1)) == {(1, 0, 1): 0.75, (0, 1, 2): 0.25}
    assert race.moves((0, 1, 2)) == {(1, 1, 1): 0.5, (0, 2, 2): 0.5}


def test_the_breaks_are_left_out_where_they_do_not_matter() -> None:
    assert Race(2, 2, Rack(0.5), breaks=winner_breaks).start == (0, 0)


@pytest.mark.parametrize(("m", "n", "p"), [(1, 1, 0.3), (3, 2, 2 / 3), (7, 5, 0.55), (2, 9, 0.1)])
def test_a_race_is_a_binomial_tail(m: int, n: int, p: float) -> None:
    # Play m+n-1 racks in any case: player 1 has won the race if he wins m of them or more.
    last = m + n - 1
    tail = sum(comb(last, k) * p**k * (1 - p) ** (last - k) for k in range(m, last + 1))
    assert chance(Race(m, n, Rack(p))) == pytest.approx(tail, rel=1e-14)


def test_games_on_the_wire() -> None:
    assert chance(Race(5, 5, Rack(0.6), score=(2, 3))) == pytest.approx(
        chance(Race(3, 2, Rack(0.6))), rel=1e-14
    )


@given(st.integers(1, 6), st.integers(1, 6), st.integers(1, 4))
def test_win_by_follows_its_definition(m: int, n: int, k: int) -> None:
    race = Race(m, n, Rack(0.5), win_by=k)
    for a, b in product(range(m + 8), range(n + 8)):
        lead = (a - m) - (b - n)
        won = 1 if a >= m and lead >= k else 2 if b >= n and -lead >= k else None
        assert race.decided(a, b) == won
        folded = race.fold(a, b)
        assert race.fold(*folded) == folded
        # The fold of a score is decided as the score is, if play can reach the score at all.
        if not any(race.decided(*before) for before in ((a - 1, b), (a, b - 1))):
            assert race.decided(*folded) == won


@given(
    st.integers(1, 5),
    st.integers(1, 5),
    st.integers(1, 3),
    st.sampled_from([0.0, 0.25, 0.5, 1.0]),
    st.sampled_from(sorted(BREAK_FORMATS)),
)
def test_win_by_is_the_unfolded_race(m: int, n: int, k: int, p: float, name: str) -> None:
    """Play with the true score for 60 racks: what is not over by then is all but nothing."""
    rack = Rack(p, 0.625)
    race = Race(m, n, rack, win_by=k, breaks=BREAK_FORMATS[name])
    level, won = {(0, 0, 1): 1.0}, 0.0
    for _ in range(60):
        deeper: dict[tuple[int, int, int], float] = {}
        for (a, b, breaker), weight in level.items():
            for winner in (1, 2):
                after = (a + 1, b) if winner == 1 else (a, b + 1)
                more = weight * rack.chance(winner, breaker)
                if race.decided(*after) is None:
                    state = (*after, BREAK_FORMATS[name](breaker, winner))
                    deeper[state] = deeper.get(state, 0.0) + more
                else:
                    won += more * (race.decided(*after) == 1)
        level = deeper
    assert won - 1e-12 <= chance(race) <= won + sum(level.values()) + 1e-12


def test_deuce_has_few_states() -> None:
    assert len(arcs_of(Race(5, 5, Rack(0.5), win_by=2)).states) < 40


def test_win_by_two_at_deuce() -> None:
    # From 4:4 either player must win two in a row: p^2 / (p^2 + q^2).
    race = Race(5, 5, Rack(0.6), win_by=2, score=(4, 4))
    assert chance(race) == pytest.approx(0.36 / 0.52, rel=1e-14)


@pytest.mark.parametrize("n", [1, 2, 5])
def test_in_an_even_race_the_format_changes_nothing(n: int) -> None:
    """Kingston 1976, Anderson 1977: winner, loser and alternate breaks give the same chance."""
    rack = Rack(0.7, 0.45)
    chances = [
        chance(Race(n, n, rack, breaks=BREAK_FORMATS[name]))
        for name in ("winner", "loser", "alternate")
    ]
    assert chances == pytest.approx([chances[0]] * 3, rel=1e-13)


@given(st.integers(1, 4), st.integers(1, 4), st.integers(1, 3))
def test_a_start_score_is_one_that_play_can_reach(m: int, n: int, k: int) -> None:
    race = Race(m, n, Rack(0.5), win_by=k)
    played, frontier = {(0, 0)}, [(0, 0)]
    for a, b in frontier:
        if race.decided(a, b) is None and a + b < 12:
            frontier += {(a + 1, b), (a, b + 1)} - played
            played |= {(a + 1, b), (a, b + 1)}
    for a, b in product(range(12), range(12)):
        if a + b >= 12:
            continue
        if (a, b) in played:
            Race(m, n, Rack(0.5), win_by=k, score=(a, b))
        else:
            with pytest.raises(InputError, match="can't be reached"):
                Race(m, n, Rack(0.5), win_by=k, score=(a, b))


def test_a_match_of_sets() -> None:
    # P5.8: 3:1 in sets that are races to 3, p = .6
    single = chance(Race(3, 3, Rack(0.6)))
    assert chance(Race(3, 1, Race(3, 3, Rack(0.6)))) == pytest.approx(single**3, rel=1e-14)


def test_sets_of_sets() -> None:
    inner = Race(2, 2, Rack(0.6))
    deep = Race(2, 1, Race(1, 2, inner))
    p = chance(inner)
    middle = 1 - (1 - p) ** 2
    assert chance(deep) == pytest.approx(middle**2, rel=1e-14)


def test_breaks_are_carried_across_sets() -> None:
    sets = Race(2, 2, Race(2, 2, Rack(1, 1), breaks=alternate_breaks))
    # Each breaker wins his rack: 1-1, then the first breaker wins 2-1; the next set
    # begins with the other, who wins it, and so does the third with the first.
    assert chance(sets) == 1.0


def test_the_set_winner_breaks() -> None:
    sets = Race(2, 2, Race(2, 2, Rack(1, 1), breaks=alternate_breaks), breaks=winner_breaks)
    assert sets.start == (0, 0, 1, (0, 0, 1))
    assert chance(sets) == 1.0
    assert (
        chance(
            Race(
                2,
                2,
                Race(2, 2, Rack(1, 1), breaks=alternate_breaks),
                breaks=winner_breaks,
                first_breaker=2,
            )
        )
        == 0.0
    )


@each_of(
    "parameters, words",
    [
        ({"m": 0}, "m must be a whole number, 1 or more; you gave 0"),
        ({"m": 2.5}, r"gave 2\.5"),
        ({"n": "five"}, "gave 'five'"),
        ({"n": -1}, "gave -1"),
        (
            {"rack": 0.5},
            (
                r"rack must be a Rack\(p\), a Rack\(p1, p2\), a match, or a game with start, "
                r"moves and winner; you gave 0\.5"
            ),
        ),
        ({"rack": Rack(0.5, 0.5)}, "breaks is missing"),
        (
            {"breaks": "winner"},
            "breaks must be a break format such as winner_breaks; you gave 'winner'",
        ),
        (
            {"breaks": lambda b, w: b + w},
            r"breaks\(1, 2\), the next breaker, must be 1 or 2; you gave 3",
        ),
        ({"first_breaker": 3}, "first_breaker must"),
        ({"first_breaker": np.array([1, 2])}, "first_breaker must be 1 or 2; you gave array"),
        ({"score": (1, 1, 1)}, r"score is \(1, 1, 1\)\. Give the games that each player"),
        ({"score": 2}, r"score is 2\. Give the games that each player"),
        ({"win_by": 0}, "win_by must"),
        ({"score": (-1, 0)}, "score of player 1 must be a whole number, 0 or more; you gave -1"),
        (
            {"score": (0, 1.5)},
            r"score of player 2 must be a whole number, 0 or more; you gave 1\.5",
        ),
        ({"score": (6, 0)}, "score is 6-0, which can't be reached"),
        ({"score": (5, 4)}, "score is 5-4, which can't be reached"),
        ({"score": (6, 4)}, "score is 6-4, which can't be reached"),
        ({"score": (7, 3), "win_by": 2}, "score is 7-3, which can't be reached"),
    ],
)
def test_what_a_race_cannot_be(parameters: dict[str, object], words: str) -> None:
    given = {"m": 5, "n": 4, "rack": Rack(0.5)} | parameters
    with pytest.raises(InputError, match=words):
        Race(**given)  # type: ignore[arg-type]
