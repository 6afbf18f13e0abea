import itertools
import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from evenbreak import InputError
from evenbreak.chains import chain_of, stochastic_limit
from evenbreak.games import OneBall, OneBallLookAhead
from evenbreak.practice import (
    ShotChoice,
    break_even_p2,
    compare_shots,
    critical_p2,
    look_ahead_win,
    one_ball_win,
)
from rows import each_of

CHANCES = st.sampled_from([0.0, 1.0, 0.5]) | st.floats(1e-200, 1.0)
INNER = st.floats(0.02, 0.98)
BOTH = st.sampled_from(["infinite", "two shots"])

P5_22 = [
    (0.1, 0.9, 0.11, 0.15),
    (0.9, 0.1, 0.99, 0.95),
    (0.9, 0.9, 0.90, 0.90),
    (0.5, 0.5, 0.67, 0.62),
    (0.25, 0.33, 0.50, 0.50),
    (0.4, 0.8, 0.45, 0.46),
    (0.3, 0.3, 0.59, 0.55),
]


@given(CHANCES, CHANCES, st.lists(CHANCES, max_size=4))
def test_a_choice_with_later_shots_is_the_game_with_these_shots(p1, p2, later):
    shot = ShotChoice("1", p1, p2, later)
    game = OneBallLookAhead([p1, p2, *later])
    assert shot.win("all shots") == pytest.approx(chance_of_winning(game), rel=1e-12, abs=1e-15)
    if not later:
        assert shot.win("all shots") == pytest.approx(shot.win("two shots"), rel=1e-12, abs=1e-15)


@given(INNER, INNER, st.lists(INNER, max_size=4))
def test_with_the_p2_found_a_choice_with_later_shots_wins_that_often(p1, p2, later):
    win = ShotChoice("1", p1, p2, later).win("all shots")
    found = ShotChoice("1", p1, 0.5, later).break_even_p2(win, "all shots")
    assert found == pytest.approx(p2, abs=1e-9)


def test_later_shots_must_be_chances():
    with pytest.raises(InputError, match=r"later\[1\]"):
        ShotChoice("1", 0.5, 0.5, (0.5, 1.5))
    with pytest.raises(InputError, match="look_ahead"):
        one_ball_win(0.5, 0.5, look_ahead="all shots")


def chance_of_winning(game):
    """Return P(player 1 wins) by the game's graph."""
    limit = stochastic_limit(chain_of(game))
    return math.fsum(
        p
        for state, p in zip(limit.states, limit.probability, strict=True)
        if game.winner(state) == 1
    )


@pytest.mark.parametrize(("p1", "p2", "infinite", "two_shots"), P5_22)
def test_rows_of_p5_22(p1, p2, infinite, two_shots):
    # The text rounds some and cuts others: .9091 to .90, .4545 to .45.
    assert one_ball_win(p1, p2) == pytest.approx(infinite, abs=0.0101)
    assert one_ball_win(p1, p2, look_ahead="two shots") == pytest.approx(two_shots, abs=0.0101)


@given(st.fractions(0, 1, max_denominator=1000), st.fractions(0, 1, max_denominator=1000))
def test_exact_fractions(p1, p2):
    q1, q2 = 1 - p1, 1 - p2
    if q1 * q2 != 1:
        assert one_ball_win(p1, p2) == pytest.approx(float(p1 / (1 - q1 * q2)), rel=1e-14)
    two_shots = one_ball_win(p1, p2, look_ahead="two shots")
    assert two_shots == pytest.approx(float(p1 + q1 * q2 / 2), rel=1e-14)


@given(CHANCES, CHANCES)
def test_infinite_look_ahead_agrees_with_its_graph(p1, p2):
    assert one_ball_win(p1, p2) == pytest.approx(chance_of_winning(OneBall(p1, p2)), rel=1e-12)


@given(st.lists(CHANCES, min_size=1, max_size=7), CHANCES)
def test_look_ahead_agrees_with_its_graph(shots, after):
    game = OneBallLookAhead(shots, after=after)
    assert look_ahead_win(game) == pytest.approx(chance_of_winning(game), rel=1e-12, abs=1e-15)


@given(INNER, INNER)
def test_look_ahead_of_two_and_of_many_shots(p1, p2):
    two = look_ahead_win(OneBallLookAhead([p1, p2]))
    assert two == pytest.approx(one_ball_win(p1, p2, look_ahead="two shots"))
    many = look_ahead_win(OneBallLookAhead([p1, p2] * 400))
    assert many == pytest.approx(one_ball_win(p1, p2))


def test_nobody_wins_who_never_makes_a_ball():
    assert one_ball_win(0, 0) == 0.0
    assert one_ball_win(0, 0, look_ahead="two shots") == 0.5
    assert one_ball_win(1e-300, 0) == 1.0
    assert one_ball_win(1e-300, 1e-300) == 0.5


def test_arrays_broadcast():
    p1, p2 = np.array([[0.0], [0.5], [1.0]]), np.array([0.0, 0.3])
    for look_ahead in ("infinite", "two shots"):
        many = one_ball_win(p1, p2, look_ahead=look_ahead)
        assert many.shape == (3, 2)
        for i, j in itertools.product(range(3), range(2)):
            assert many[i, j] == one_ball_win(p1[i, 0], p2[j], look_ahead=look_ahead)


@given(st.floats(1e-3, 0.5), BOTH)
def test_at_the_critical_p2_the_game_is_even(p1, look_ahead):
    p2 = critical_p2(p1)
    assert one_ball_win(p1, min(p2, 1.0), look_ahead=look_ahead) == pytest.approx(0.5)


@given(st.floats(0.5, 1.0, exclude_min=True), CHANCES, BOTH)
def test_above_one_half_player_1_is_the_favorite_whatever_he_leaves(p1, p2, look_ahead):
    assert critical_p2(p1) > 1.0
    assert one_ball_win(p1, p2, look_ahead=look_ahead) > 0.5


def test_critical_p2_of_numbers_and_arrays():
    assert critical_p2(0.25) == 1 / 3
    assert critical_p2(1) == math.inf
    assert critical_p2(np.array([0.0, 0.5])).tolist() == [0.0, 1.0]


@given(INNER, INNER, BOTH)
def test_break_even_p2_gives_that_chance(p1, p2, look_ahead):
    win = one_ball_win(p1, p2, look_ahead=look_ahead)
    assert break_even_p2(p1, win, look_ahead=look_ahead) == pytest.approx(p2, abs=1e-12)


@pytest.mark.parametrize("look_ahead", ["infinite", "two shots"])
def test_no_p2_breaks_even(look_ahead):
    assert break_even_p2(1.0, 1.0, look_ahead=look_ahead) is None
    assert break_even_p2(0.8, 0.5, look_ahead=look_ahead) is None
    assert break_even_p2(0.0, 0.7, look_ahead=look_ahead) is None
    assert break_even_p2(0.5, 0.0, look_ahead=look_ahead) is None
    assert break_even_p2(1 - 2**-53, 1e-310, look_ahead=look_ahead) is None


@pytest.mark.parametrize(
    ("p1", "p2", "region"),
    [
        (0.1, 0.9, "sell-out"),
        (0.4, 0.8, "sell-out"),
        (0.9, 0.1, "two-way shot"),
        (0.9, 0.9, "must-make"),
        (0.3, 0.3, "safety"),
        (0.5, 0.5, "must-make"),
        (0.5, 0.49, "two-way shot"),
        (0.49, 0.5, "sell-out"),
    ],
)
def test_regions_are_those_of_p5_22(p1, p2, region):
    assert ShotChoice("", p1, p2).region == region


SHOTS = st.lists(st.builds(ShotChoice, st.text(max_size=3), INNER, INNER), min_size=2, max_size=5)


@pytest.mark.slow
@given(SHOTS, BOTH)
def test_the_best_shot_comes_first(shots, look_ahead):
    ranked = compare_shots(shots, look_ahead=look_ahead)
    assert sorted(map(id, shots)) == sorted(id(one.shot) for one in ranked)
    best = max(shot.win(look_ahead) for shot in shots)
    for before, after in itertools.pairwise(ranked):
        assert before.win == pytest.approx(after.win, rel=0, abs=1e-12) or before.win > after.win
    assert all(one.behind == best - one.win >= 0.0 for one in ranked)
    assert ranked[0].behind == pytest.approx(0.0, abs=1e-12)


@given(SHOTS, BOTH)
def test_the_choice_turns_at_the_turning_p2(shots, look_ahead):
    ranked = compare_shots(shots, look_ahead=look_ahead)
    assume(ranked[0].win - ranked[1].win > 1e-6)
    for place, one in enumerate(ranked):
        others = [other.shot for other in ranked if other is not one]

        def best(p2, others=others, p1=one.shot.p1):
            changed = ShotChoice("changed", p1, p2)
            return compare_shots([*others, changed], look_ahead=look_ahead)[0].shot is changed

        turn = one.turning_p2
        if turn is None:
            assert best(1.0) == best(0.0) == (place == 0)
        else:
            assert best(max(turn - 1e-9, 0.0)) or turn < 1e-8
            assert not best(min(turn + 1e-9, 1.0)) or turn > 1 - 1e-8


@given(SHOTS)
def test_choosing_anew_after_every_miss_is_worth_no_more(shots):
    value = 0.0
    for _ in range(2000):
        value = max(shot.p1 + (1 - shot.p1) * (1 - shot.p2) * value for shot in shots)
    assert compare_shots(shots)[0].win == pytest.approx(value)


def test_equals_keep_their_order_and_one_alone_has_nothing_to_turn():
    first, second = ShotChoice("first", 0.5, 0.5), ShotChoice("second", 0.5, 0.5)
    ranked = compare_shots([first, second])
    assert [one.shot.name for one in ranked] == ["first", "second"]
    assert ranked[0].turning_p2 == pytest.approx(0.5)
    (alone,) = compare_shots([first])
    assert (alone.behind, alone.turning_p2) == (0.0, None)


@pytest.mark.parametrize("order", [1, -1])
@pytest.mark.parametrize(
    ("chances", "look_ahead"),
    [([(0.1, 0.05), (0.25, 0.15)], "infinite"), ([(0.05, 0.1), (0.45, 0.9)], "two shots")],
)
def test_shots_that_only_rounding_tells_apart_keep_their_order(chances, look_ahead, order):
    shots = [ShotChoice(str(pair), *pair) for pair in chances[::order]]
    assert len({shot.win(look_ahead) for shot in shots}) == 2
    ranked = compare_shots(shots, look_ahead=look_ahead)
    assert [one.shot for one in ranked] == shots
    assert min(one.behind for one in ranked) == 0.0


def test_a_shot_may_have_fractions():
    assert ShotChoice("exact", Fraction(1, 3), Fraction(1, 2)).win() == pytest.approx(0.5)


@each_of(
    "ask, remedy",
    [
        (lambda: one_ball_win(1.5, 0.5), "p1 must be a number from 0 to 1; you gave 1.5"),
        (lambda: one_ball_win(0.5, math.nan), "p2 must be a number from 0 to 1; you gave nan"),
        (lambda: one_ball_win([0.5] * 2, [0.5] * 3), "broadcast"),
        (lambda: one_ball_win(0.5, 0.5, look_ahead="three"), "'infinite' or 'two shots'"),
        (lambda: critical_p2(-0.1), "p1 must be a number from 0 to 1; you gave -0.1"),
        (lambda: break_even_p2(0.5, 2), "win must"),
        (lambda: break_even_p2(0.5, 0.5, look_ahead=2), "'infinite' or 'two shots'"),
        (
            lambda: ShotChoice("bank", 0.5, "often"),
            "p2 must be a number from 0 to 1; you gave 'often'",
        ),
        (lambda: compare_shots([]), "shots must have"),
        (
            lambda: compare_shots([(0.4, 0.6)]),
            "a shot must be ShotChoice(name, p1, p2); you gave (0.4, 0.6)",
        ),
        (
            lambda: compare_shots([ShotChoice("", 0.5, 0.5)], look_ahead=""),
            "'two shots' or 'all shots'",
        ),
    ],
)
def test_wrong_values_say_how_to_mend_them(ask, remedy):
    with pytest.raises(InputError) as caught:
        ask()
    assert remedy in str(caught.value)
