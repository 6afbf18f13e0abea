import itertools
import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.chains import chain_of, long_run_reward, spectrum
from evenbreak.errors import InputError
from evenbreak.games import (
    BREAK_FORMATS,
    Rack,
    Series,
    alternate_breaks,
    loser_breaks,
    player_1_breaks,
    player_2_breaks,
    winner_breaks,
)
from evenbreak.practice import (
    compare_break_formats,
    first_break_worth,
    long_run_sd,
    long_run_share,
)
from evenbreak.practice.breaks import Breakers
from rows import each_of

CHANCES = st.sampled_from([0.0, 1.0, 0.5]) | st.floats(0.0, 1.0)
INNER = st.floats(0.02, 0.98)

TABLE_5_4 = [
    (0.1, 0.1, 0.5, 0.5, 0.5),
    (0.5, 0.5, 0.5, 0.5, 0.5),
    (0.9, 0.9, 0.5, 0.5, 0.5),
    (0.1, 0.9, 0.1, 0.1, 0.1),
    (0.9, 0.1, 0.9, 0.9, 0.9),
    (0.5, 0.1, 0.64, 0.83, 0.7),
    (0.5, 0.9, 0.17, 0.36, 0.3),
    (0.9, 0.5, 0.83, 0.64, 0.7),
    (0.1, 0.5, 0.36, 0.17, 0.3),
    (0.95, 0.94, 0.54, 0.50, 0.505),
]


def every_format():
    """Return all 16 functions of (breaker, winner), the usual five among them."""

    def format_of(nexts):
        return lambda breaker, winner: nexts[2 * breaker + winner - 3]

    return [format_of(nexts) for nexts in itertools.product((1, 2), repeat=4)]


def moments(p1, p2, breaks, first, racks):
    """Return mean and variance of player 1's wins over so many racks, rack by rack."""
    chances = {1: p1, 2: 1 - p2}
    chance = {1: int(first == 1), 2: int(first == 2)}
    total, square = {1: 0, 2: 0}, {1: 0, 2: 0}
    for _ in range(racks):
        after = [{1: 0, 2: 0} for _ in range(3)]
        for breaker, win in chances.items():
            for winner, p in ((1, win), (2, 1 - win)):
                point, to = int(winner == 1), breaks(breaker, winner)
                after[0][to] += p * chance[breaker]
                after[1][to] += p * (total[breaker] + point * chance[breaker])
                after[2][to] += p * (
                    square[breaker] + 2 * point * total[breaker] + point * chance[breaker]
                )
        chance, total, square = after
    mean = sum(total.values())
    return mean, sum(square.values()) - mean**2


@each_of("p1, p2, winner, loser, alternate", TABLE_5_4)
def test_table_5_4(p1, p2, winner, loser, alternate):
    # The text cuts .5454... in row 10 to .54, so a little over half a unit.
    assert long_run_share(p1, p2, winner_breaks) == pytest.approx(winner, abs=0.0055)
    assert long_run_share(p1, p2, loser_breaks) == pytest.approx(loser, abs=0.0055)
    assert long_run_share(p1, p2, alternate_breaks) == pytest.approx(alternate, abs=1e-12)


@given(st.fractions(0, 1), st.fractions(0, 1))
def test_the_formulas_of_the_usual_formats(p1, p2):
    q1, q2 = 1 - p1, 1 - p2
    if q1 + q2:
        assert long_run_share(p1, p2, winner_breaks) == pytest.approx(float(q2 / (q1 + q2)))
    if p1 + p2:
        assert long_run_share(p1, p2, loser_breaks) == pytest.approx(float(p1 / (p1 + p2)))
    assert long_run_share(p1, p2, alternate_breaks) == pytest.approx(float((p1 + q2) / 2))
    assert long_run_share(p1, p2, player_1_breaks) == pytest.approx(float(p1))
    assert long_run_share(p1, p2, player_2_breaks) == pytest.approx(float(q2))


@given(CHANCES, CHANCES, st.sampled_from(every_format()), st.sampled_from([1, 2]))
def test_any_format_agrees_with_its_chain(p1, p2, breaks, first):
    series = Series(Rack(p1, p2), breaks=breaks, first_breaker=first)
    chain = chain_of(series)
    rewards = {state: series.rack.chance(1, state) for state in chain.states}
    share = long_run_share(p1, p2, breaks, first_breaker=first)
    assert share == pytest.approx(long_run_reward(chain, per_state=rewards), abs=1e-12)


def test_a_break_that_never_passes_on_leaves_all_to_the_start():
    assert long_run_share(1, 1, winner_breaks) == 1.0
    assert long_run_share(1, 1, winner_breaks, first_breaker=2) == 0.0
    assert long_run_share(0, 0, loser_breaks) == 0.0
    assert long_run_share(0, 0, loser_breaks, first_breaker=2) == 1.0
    assert first_break_worth(1, 1, winner_breaks) == math.inf
    assert first_break_worth(0, 0, loser_breaks) == -math.inf
    assert long_run_sd(1, 1, winner_breaks) == long_run_sd(0, 0, loser_breaks) == 0.0


@given(INNER, INNER)
def test_alternate_breaks_lie_between_and_favor_the_same_player(p1, p2):
    winner, loser, alternate = (
        long_run_share(p1, p2, breaks) for breaks in (winner_breaks, loser_breaks, alternate_breaks)
    )
    assert min(winner, loser) - 1e-12 <= alternate <= max(winner, loser) + 1e-12
    for share in (winner, loser, alternate):
        assert (share - 0.5) * (p1 - p2) >= -1e-12
    # Winner breaks stretches a lead of those who hold their breaks, and shrinks the others'.
    assert (winner - loser) * (p1 - p2) * (p1 + p2 - 1) >= -1e-12


@given(INNER, st.sampled_from(every_format()))
def test_without_break_advantage_the_format_does_not_matter(p, breaks):
    assert long_run_share(p, 1 - p, breaks) == pytest.approx(p)
    assert long_run_sd(p, 1 - p, breaks) == pytest.approx(math.sqrt(p * (1 - p)))


@given(CHANCES, CHANCES, st.sampled_from(list(BREAK_FORMATS)))
def test_the_players_may_change_places(p1, p2, name):
    other = {"player 1": "player 2", "player 2": "player 1"}.get(name, name)
    mine = long_run_share(p1, p2, BREAK_FORMATS[name])
    theirs = long_run_share(p2, p1, BREAK_FORMATS[other], first_breaker=2)
    assert mine + theirs == pytest.approx(1.0)


@each_of("first", [1, 2])
@each_of("breaks", every_format())
@each_of("p1, p2", [(0.7, 0.6), (0.3, 0.8), (0.25, 0.35)])
def test_sd_is_the_growth_of_the_variance(p1, p2, breaks, first):
    (_, before), (_, after) = (  # two racks apart: a period of 2 cancels
        moments(p1, p2, breaks, first, racks) for racks in (300, 302)
    )
    sd = long_run_sd(p1, p2, breaks, first_breaker=first)
    assert sd**2 == pytest.approx((after - before) / 2, rel=1e-8)


@each_of("breaks", every_format())
def test_the_first_break_is_worth_what_the_means_differ_by(breaks):
    one, two = Fraction("0.7"), Fraction("0.45")
    lead = [
        moments(one, two, breaks, 1, racks)[0] - moments(one, two, breaks, 2, racks)[0]
        for racks in (60, 61)
    ]
    worth = first_break_worth(0.7, 0.45, breaks)
    if math.isinf(worth):
        assert all(breaks(breaker, winner) == breaker for breaker in (1, 2) for winner in (1, 2))
    else:
        assert worth == pytest.approx(float(sum(lead)) / 2, rel=1e-9)


@given(st.floats(0.5, 0.98))
def test_strings_of_wins_swing_more(p):
    winner, loser, alternate = (
        long_run_sd(p, p, breaks) for breaks in (winner_breaks, loser_breaks, alternate_breaks)
    )
    assert winner == pytest.approx(math.sqrt(p / (1 - p)) / 2)
    assert loser == pytest.approx(math.sqrt((1 - p) / p) / 2)
    assert winner >= alternate - 1e-12 >= loser - 2e-12


def test_arrays_broadcast():
    p1, p2 = np.array([[0.9], [0.5], [1.0]]), np.array([0.5, 1.0])
    for ask in (long_run_share, long_run_sd, first_break_worth):
        many = ask(p1, p2, winner_breaks)
        assert many.shape == (3, 2)
        for i, j in itertools.product(range(3), range(2)):
            assert many[i, j] == ask(p1[i, 0], p2[j], winner_breaks)


def test_stakes_of_p5_25():
    values = {value.name: value for value in compare_break_formats(Rack(0.9, 0.5), win=1, lose=2)}
    exact = {
        "winner": Fraction(1, 2),
        "loser": Fraction(-1, 14),
        "alternate": Fraction(1, 10),
        "player 1": Fraction(7, 10),
        "player 2": Fraction(-1, 2),
    }
    assert {name: value.points for name, value in values.items()} == pytest.approx(
        {name: float(points) for name, points in exact.items()}
    )
    assert list(values) == ["player 1", "winner", "alternate", "loser", "player 2"]
    assert values["winner"].sd_points == pytest.approx(3 * long_run_sd(0.9, 0.5, winner_breaks))


@given(INNER, INNER, st.floats(0.1, 10))
def test_fair_stakes_are_fair(p1, p2, lose):
    for value in compare_break_formats(Rack(p1, p2)):
        again = compare_break_formats(Rack(p1, p2), win=value.fair_ratio * lose, lose=lose)
        points = {other.name: other.points for other in again}
        assert points[value.name] == pytest.approx(0.0, abs=1e-12 * lose)


def test_fair_ratio_keeps_its_digits_at_both_ends():
    best = compare_break_formats(Rack(1 - 2**-50, 2**-50))
    assert [value.fair_ratio for value in best] == pytest.approx([2**-50] * 5)
    assert compare_break_formats(Rack(0, 1))[0].fair_ratio == math.inf
    # In loser breaks player 1 loses the fraction p2 / (p1 + p2) of the racks.
    ratios = {value.name: value.fair_ratio for value in compare_break_formats(Rack(0.5, 1e-20))}
    assert ratios["loser"] == pytest.approx(2e-20, rel=1e-12, abs=0)


@given(INNER, INNER)
def test_memory_is_the_second_eigenvalue(p1, p2):
    for value in compare_break_formats(Rack(p1, p2)):
        if value.name.startswith("player"):
            assert value.memory == 0.0
            continue
        chain = chain_of(Series(Rack(p1, p2), breaks=BREAK_FORMATS[value.name]))
        second = min(spectrum(chain).values.real)
        assert value.memory == pytest.approx(second, abs=1e-9)


def test_a_rack_whose_break_does_not_matter():
    values = compare_break_formats(Rack(0.6), first_breaker=2)
    assert [value.name for value in values] == list(BREAK_FORMATS)
    assert {round(value.share, 12) for value in values} == {0.6}
    assert {round(value.first_break, 12) for value in values} == {0.0}


@each_of(
    "ask, remedy",
    [
        (lambda: long_run_share(1.5, 0.5, winner_breaks), "number from 0 to 1"),
        (lambda: long_run_share(0.5, None, winner_breaks), "p2 is missing"),
        (lambda: long_run_share([0.5] * 2, [0.5] * 3, winner_breaks), "broadcast"),
        (lambda: long_run_share(0.5, 0.5, "winner"), "such as winner_breaks"),
        (lambda: long_run_share(0.5, 0.5, winner_breaks, first_breaker=0), "must be 1 or 2"),
        (lambda: long_run_sd(0.5, 0.5, winner_breaks, first_breaker=0), "must be 1 or 2"),
        (lambda: compare_break_formats((0.5, 0.5)), "Rack(p1, p2)"),
        (lambda: compare_break_formats(Rack([0.5], 0.5)), "one number"),
        (lambda: compare_break_formats(Rack(0.5, 0.5), win=-1), "0 or more"),
        (lambda: compare_break_formats(Rack(0.5, 0.5), lose=math.inf), "0 or more"),
        (lambda: compare_break_formats(Rack(0.5, 0.5), lose="two"), "0 or more"),
        (lambda: compare_break_formats(Rack(0.5, 0.5), first_breaker=3), "must be 1 or 2"),
    ],
)
def test_wrong_values_say_how_to_mend_them(ask, remedy):
    with pytest.raises(InputError) as caught:
        ask()
    assert remedy in str(caught.value)


@each_of("breaks", BREAK_FORMATS.values())
@each_of("first", [1, 2])
def test_the_fraction_won_is_the_long_run_reward_of_the_series(breaks, first):
    rack = Rack(0.7, 0.6)
    series = Series(rack, breaks=breaks, first_breaker=first)
    breakers = Breakers.of(0.7, 0.6, breaks)
    chain = chain_of(series)
    per_state = {state: rack.chance(1, state) for state in chain.states}
    reward = long_run_reward(chain, per_state=per_state)
    assert breakers.won(first) == pytest.approx(reward)
    assert breakers.won(first) + breakers.lost(first) == pytest.approx(1.0)
    assert sum(breakers.broken(first)) == pytest.approx(1.0)


def test_a_break_that_never_passes_on_stays_with_the_first_breaker():
    breakers = Breakers.of(1.0, 1.0, winner_breaks)
    assert [float(part) for part in breakers.broken(2)] == [0.0, 1.0]
    assert breakers.first_break == math.inf
    assert Breakers.of(0.0, 0.0, loser_breaks).first_break == -math.inf


def test_arrays_are_many_pairs_of_players():
    breakers = Breakers.of([0.5, 0.75], 0.75, winner_breaks)
    assert breakers.won(1).shape == (2,)
    assert np.allclose(breakers.first_break, [1 / 3, 1.0])


def test_pulls_are_the_next_breaks_after_a_win_less_those_after_a_loss():
    assert Breakers.of(0.5, 0.5, winner_breaks).pulls == (1, 1)
    assert Breakers.of(0.5, 0.5, loser_breaks).pulls == (-1, -1)


def test_both_chances_are_needed():
    with pytest.raises(InputError, match="p2 is missing"):
        Breakers.of(0.5, None, winner_breaks)
