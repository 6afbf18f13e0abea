"""How many players a gain rests on, and its error by players, beside slow and obvious ways."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.ratings.clear_gains import FEWEST_PLAYERS, LIKELY, by_enough_players, is_clear
from evenbreak.ratings.players_behind import PlayersBehind
from evenbreak.ratings.stretches import StretchLosses
from tiers import examples

MATCHES = st.lists(
    st.tuples(st.integers(0, 6), st.integers(1, 6), st.integers(-4, 4)),
    min_size=1,
    max_size=20,
)


def columns(drawn):
    a = np.array([row[0] for row in drawn])
    return PlayersBehind(a, (a + [row[1] for row in drawn]) % 7), np.array(
        [float(r[2]) for r in drawn]
    )


@given(MATCHES)
@settings(max_examples=examples(100))
def test_matches_with_a_player_in_common_go_together(drawn):
    players, u = columns(drawn)
    sets = [{a, b} for a, b in zip(*players, strict=True)]
    variance = sum(u[k] * u[m] for k in range(len(u)) for m in range(len(u)) if sets[k] & sets[m])
    np.testing.assert_allclose(players.spread(u) ** 2, max(variance, (u**2).sum()), atol=1e-9)


@given(MATCHES)
@settings(max_examples=examples(100))
def test_players_are_left_out_until_nothing_is_gained(drawn):
    players, u = columns(drawn)
    of_player = [u[(players[0] == k) | (players[1] == k)].sum() for k in range(7)]
    order, gone, by_hand = sorted(range(7), key=lambda k: -of_player[k]), set(), 0
    while sum(x for x, *ends in zip(u, *players, strict=True) if not gone & set(ends)) > 1e-9:
        gone.add(order[by_hand])
        by_hand += 1
    assert players.behind(u) == by_hand


def of_some(gains, players):
    """Return whether a gain counts that some players make in ten matches each, against others."""
    a = np.repeat(np.arange(players), 10)
    b = players + np.arange(len(a))
    each = np.repeat(np.asarray(gains, dtype=float), 10)
    losses = np.column_stack([each, np.zeros(len(each))])
    ways = StretchLosses(losses, np.ones(len(each)), losses, PlayersBehind(a, b))
    return by_enough_players(ways, 1)


def test_what_few_players_gain_is_not_enough():
    assert of_some([0.5] * FEWEST_PLAYERS, FEWEST_PLAYERS)[0]
    assert not of_some([0.5] * (FEWEST_PLAYERS - 1), FEWEST_PLAYERS - 1)[0]
    assert not of_some([5.0] + [0.01] * 40, 41)[0]
    assert of_some([0.5, -0.3] * 30, 60)[0]
    assert not of_some([0.5, -0.49] * 30, 60)[0]


def test_the_error_covers_a_sum_over_players_who_differ():
    """400 leagues of 30 players, whose matches share what a player gains: z is nearly normal."""
    rng = np.random.default_rng(1)
    far = 0
    for _ in range(400):
        of_player = rng.normal(size=30)
        a = rng.integers(0, 30, 300)
        b = (a + rng.integers(1, 30, 300)) % 30
        u = of_player[a] + of_player[b] + rng.normal(size=300)
        far += u.sum() > LIKELY * PlayersBehind(a, b).spread(u)
    assert 0.06 <= far / 400 <= 0.14


def test_what_changes_nothing_is_not_clear():
    nothing = StretchLosses(
        np.ones((20, 3)), np.ones(20), np.ones((20, 3)), PlayersBehind(*np.zeros((2, 20), int))
    )
    assert not is_clear(nothing)
