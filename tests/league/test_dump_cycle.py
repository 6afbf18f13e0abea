"""Dumping and playing by turns: the share that must be won, and a simulation."""

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import Ladder, chart
from evenbreak.league.dump_cycle import best_cycle, dump_cycle
from evenbreak.league.sandbag_pay import dumped_matrix, earnest_matrix
from evenbreak.matches import race_win_probability


@pytest.mark.parametrize("name", ["npl_8", "npl_20"])
@pytest.mark.parametrize(("dumped", "earnest"), [(1, 4), (2, 3), (3, 7)])
def test_the_counts_alone_say_what_is_won(name, dumped, earnest):
    cycle = dump_cycle(Ladder(chart(name), widest=120), dumped, earnest, stake=4.0)
    assert cycle.held < 1e-6
    assert cycle.p_win == pytest.approx((dumped + earnest) / (2 * earnest), abs=1e-7)
    assert cycle.profit == pytest.approx((4.0 - 1.0) * dumped / 2 / (dumped + earnest), abs=1e-6)


def test_dumping_nothing_gains_nothing():
    cycle = dump_cycle(Ladder("npl"), 0, 6)
    assert cycle.rating_error == pytest.approx(0.0, abs=1e-9)
    assert (cycle.p_win, cycle.profit) == pytest.approx((0.5, 0.0))


def test_simulation_agrees_on_where_he_sits():
    players, dumped, earnest = 4000, 1, 3
    rng, error, seen = np.random.default_rng(5), np.zeros(4000, dtype=int), []
    for cycle in range(100):
        error -= dumped
        if cycle >= 80:
            seen.append(error.copy())
        for _ in range(earnest):
            m, n = chart("npl_10").races(error)
            error += np.where(rng.random(players) < race_win_probability(0.5, m, n), 1, -1)
    means = np.mean(seen, axis=0)
    expected = dump_cycle(Ladder("npl", widest=120), dumped, earnest).rating_error
    assert abs(means.mean() - expected) < 4.5 * means.std() / players**0.5


def test_no_chart_lets_a_player_win_all():
    assert dump_cycle(Ladder("npl"), 9, 9).held > 0.1
    best = best_cycle(Ladder("npl", widest=120), [4])
    assert (best.dumped, best.earnest) == (1, 3)


def test_best_of_several_lengths_and_no_length():
    ladder = Ladder("npl", widest=60)
    assert best_cycle(ladder, [4, 5], lowest=-5.0).dumped in (0, 1)
    assert best_cycle(ladder, [3], dumped_stake=100.0).dumped == 0
    with pytest.raises(InputError, match="lengths"):
        best_cycle(ladder, [])


def test_the_honest_do_not_win_half_by_steps_that_give_more_than_they_take():
    # Up 2, down 1: a rating stands still for who wins a third of all matches.
    ladder = Ladder("step 2 1", widest=120)
    assert dump_cycle(ladder, 0, 5).profit == pytest.approx(0.0, abs=1e-9)
    cycle = dump_cycle(ladder, 3, 7, stake=4.0, dumped_stake=1.0)
    assert 7 * cycle.p_win == pytest.approx(10 / 3, abs=1e-6)
    # Of ten matches he wins as many as the honest player, all of them in earnest.
    assert cycle.profit == pytest.approx((4.0 - 1.0) * 3 / 3 / 10, abs=1e-6)


def test_a_rating_that_larger_moves_cannot_take_to_the_very_end_is_held_there():
    # From 0 by steps of 3 down to -60; -61 is the end of the line.
    cycle = dump_cycle(Ladder("step 3", widest=61), 9, 1)
    assert cycle.held == pytest.approx(1.0, abs=1e-3)


def test_the_limit_is_that_of_the_powers_of_the_cycle():
    ladder = Ladder("margin 2", widest=90)
    step, dump = earnest_matrix(ladder), dumped_matrix(ladder)
    chain = np.linalg.matrix_power(step, 7) @ np.linalg.matrix_power(dump, 3)
    law = np.linalg.matrix_power(dump, 3) @ np.linalg.matrix_power(chain, 4096)[:, 90]
    expected = law @ np.arange(-90, 91)
    assert dump_cycle(ladder, 3, 7).rating_error == pytest.approx(expected, abs=1e-9)
