"""What losing on purpose pays, against enumeration, conservation of wins, and simulation."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.handicaps import CHARTS, Ladder, chart, system_of
from evenbreak.league.sandbag_pay import (
    dumped_matrix,
    earnest_matrix,
    entering_low,
    most_dumped,
    sandbagging,
)
from evenbreak.matches import race_win_probability
from tiers import examples

NPL = [name for name in CHARTS if name.startswith("npl")]


@cache
def ladder(name="npl_10"):
    return Ladder(chart(name), widest=120)


@cache
def wins_to_come(error, matches):
    """Expected wins of `matches` in earnest, by the tree of wins and losses."""
    if not matches:
        return 0.0
    m, n = chart("npl_10").race(error)
    p = race_win_probability(0.5, m, n)
    return p * (1.0 + wins_to_come(error + 1, matches - 1)) + (1.0 - p) * wins_to_come(
        error - 1, matches - 1
    )


@pytest.mark.slow_after(2)
@pytest.mark.parametrize(("dumped", "start"), [(0, 0), (3, -4), (7, 2), (9, 0)])
def test_extra_wins_are_those_of_the_tree(dumped, start):
    row = sandbagging(ladder(), dumped=dumped, earnest=12, start=start).rows[dumped]
    honest = wins_to_come(start, dumped + 12) - wins_to_come(start, dumped)
    assert row.extra_wins == pytest.approx(wins_to_come(start - dumped, 12) - honest, abs=1e-12)
    assert row.given_away == pytest.approx(wins_to_come(start, dumped), abs=1e-12)


@pytest.mark.slow
@settings(max_examples=examples(25), deadline=None)
@given(st.sampled_from(NPL), st.integers(1, 25), st.integers(1, 60), st.integers(-6, 6))
def test_at_equal_stakes_it_never_pays(name, dumped, earnest, start):
    found = sandbagging(
        ladder(name), dumped=dumped, earnest=earnest, start=start, stake=1.0, dumped_stake=1.0
    )
    assert max(row.profit for row in found.rows) <= 1e-9


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("name", NPL)
def test_all_that_was_given_away_comes_back_in_the_end(name):
    row = sandbagging(ladder(name), dumped=10, earnest=1000).rows[10]
    assert row.extra_wins == pytest.approx(5.0, rel=1e-3)
    assert row.break_even == pytest.approx(1.0, rel=1e-3)
    assert row.rating == pytest.approx(10.0)


def test_first_match_is_the_race_of_the_chart():
    rows = sandbagging(ladder(), dumped=6, earnest=1, in_a_row=4).rows
    assert [row.p_first for row in rows[5:]] == pytest.approx([0.5, 0.63671875])  # P5.6: 4:5
    assert rows[6].p_in_a_row == pytest.approx(0.63671875**4)


def test_profit_is_its_parts():
    asked = {"dumped": 8, "earnest": 10, "stake": 7.0, "dumped_stake": 2.0, "prize": 100.0}
    found = sandbagging(ladder(), in_a_row=2, **asked)
    row = found.rows[8]
    prize = 100.0 * (row.p_in_a_row - found.rows[0].p_in_a_row)
    # The honest player's law after 8 matches is wider, and his chance of two in a row with it.
    honest_now = ladder().wins ** 2 @ np.linalg.matrix_power(earnest_matrix(ladder()), 8)[:, 120]
    prize = 100.0 * (row.p_in_a_row - honest_now)
    assert row.profit == pytest.approx(7.0 * row.extra_wins + prize - 2.0 * row.given_away)
    assert found.rows[0].profit == 0.0
    assert found.best.profit == max(row.profit for row in found.rows)


@pytest.mark.slow
def test_a_law_of_errors_to_begin_with():
    law = ladder().law()
    found = sandbagging(ladder(), dumped=5, earnest=10, start=law)
    assert found.p_honest == pytest.approx(0.5)
    each = sum(
        float(p) * sandbagging(ladder(), dumped=5, earnest=10, start=int(e)).p_win[5]
        for e, p in zip(law.values, law.probability, strict=True)
        if abs(e) < 30
    )
    assert found.p_win[5] == pytest.approx(each, abs=1e-6)


def test_simulation_agrees():
    dumped, earnest, players = 8, 20, 20_000
    rng = np.random.default_rng(8)
    error = np.full(players, -dumped)
    wins = np.zeros(players)
    for _ in range(earnest):
        m, n = chart("npl_10").races(error)
        won = rng.random(players) < race_win_probability(0.5, m, n)
        wins += won
        error += np.where(won, 1, -1)
    expected = sandbagging(ladder(), dumped=dumped, earnest=earnest).p_win[dumped].sum()
    assert abs(wins.mean() - expected) < 4.5 * wins.std() / players**0.5


def test_a_dumped_match_is_the_most_costly_defeat():
    margin = Ladder("margin", chart("npl_10"), widest=60)
    matrix = dumped_matrix(margin)
    assert matrix.sum(axis=0) == pytest.approx(1.0)
    start = 60
    (there,) = np.flatnonzero(matrix[:, start])
    assert there - start == margin.steps.min() < -1


def test_entering_low_is_repaid_at_half_a_match_a_point():
    extra = entering_low(ladder(), 30, 600)
    assert (np.diff(extra) > 0).all()
    assert extra[-1] == pytest.approx(15.0, rel=1e-3)
    assert extra[0] == pytest.approx(ladder().wins[120 - 30] - 0.5)


def test_newcomer_steps_repay_it_sooner():
    extra = np.diff(entering_low(ladder(), 30, 600, newcomer=True), prepend=0.0)
    factor = np.ones(600)
    factor[:10], factor[10:30] = 3.0, 2.0
    assert (2.0 * factor * extra).sum() == pytest.approx(30.0, rel=1e-3)
    assert extra.sum() < 8.0


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({"dumped": -1}, "dumped must be a whole number from 0 to 1000; you gave -1"),
        ({"dumped": 130}, "wider ladder"),
        ({"earnest": 0}, "earnest must"),
        ({"earnest": 2000}, "earnest must be a whole number from 1 to 1000; you gave 2000"),
        ({"stake": -1.0}, r"stake must be a finite number, 0 or more; you gave -1\.0"),
        (
            {"start": 0.5},
            (
                r"start must be a rating error in whole points from -120 to 120, or make "
                r"widest larger; you gave 0\.5"
            ),
        ),
        (
            {"start": 500},
            (
                "start must be a rating error in whole points from -120 to 120, or make "
                "widest larger; you gave 500"
            ),
        ),
    ],
)
def test_what_cannot_be_is_refused(asked, message):
    with pytest.raises(InputError, match=message):
        sandbagging(ladder(), **asked)


def test_a_player_who_drifts_is_refused():
    with pytest.raises(InputError, match="drift"):
        sandbagging(Ladder("npl", drift=0.1, widest=120))
    assert replace(system_of("npl")).newcomer_steps


@pytest.mark.parametrize(("system", "start"), [("npl", 0), ("step 3", -30), ("margin", 5)])
def test_most_dumped_is_as_far_as_the_ladder_goes(system, start):
    wide = Ladder(system, widest=120)
    most = most_dumped(wide, start)
    assert sandbagging(wide, dumped=most, earnest=1, start=start).rows[-1].dumped == most
    with pytest.raises(InputError, match="wider ladder"):
        sandbagging(wide, dumped=most + 1, earnest=1, start=start)


def test_a_seldom_costly_defeat_does_not_hold_the_others_back():
    # Elo's most costly defeat comes at high ratings: from 0 the same steps lead less far.
    wide = Ladder("elo", widest=482)
    assert most_dumped(wide) > wide.widest // -int(wide.steps.min())


def test_the_cheapest_row_is_that_of_the_smallest_stakes():
    found = sandbagging(ladder(), dumped=14, earnest=20)
    assert found.cheapest.dumped == 9
    assert all(row.break_even >= found.cheapest.break_even for row in found.rows)
    # So far down that more changes nothing: no extra win, and no stakes from which it pays.
    low = sandbagging(ladder(), dumped=10, earnest=5, start=-100).rows[10]
    assert (low.extra_wins, low.break_even) == (0.0, float("inf"))
