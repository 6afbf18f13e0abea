import numpy as np
import pytest

from evenbreak.errors import AccuracyError, InputError
from evenbreak.handicaps import (
    EQUAL_SKILL,
    Ladder,
    chart,
    inflation,
    lag,
    newcomer_inflation,
)
from evenbreak.handicaps.systems.step import margin_system, step_system


@pytest.mark.parametrize(("up", "down"), [(1, 1), (2, 2), (2, 1), (1, 3)])
def test_unequal_steps_add_their_difference_with_every_match(up, down):
    ladder = Ladder(step_system(up, down), widest=200)
    assert inflation(ladder) == pytest.approx(up - down, abs=1e-12)


@pytest.mark.parametrize("opponents", [EQUAL_SKILL])
def test_steps_by_margin_conserve(opponents):
    assert inflation(Ladder(margin_system(2), opponents=opponents)) == pytest.approx(0, abs=1e-12)


def by_hand(win, start):
    """Return what a newcomer's matches add to the sum: his moves and his opponents', one by one."""
    law, total = {start: 1.0}, 0.0
    for t in range(30):
        step = 3 if t < 10 else 2
        after = {}
        for error, chance in law.items():
            for won, p in ((1, win[error]), (-1, 1 - win[error])):
                total += chance * p * (won * step - won)
                after[error + won * step] = after.get(error + won * step, 0.0) + chance * p
        law = after
    mean = sum(error * chance for error, chance in law.items())
    return total, mean


@pytest.mark.parametrize("start", [-30, -7, 0, 30])
def test_a_newcomer_adds_what_his_opponents_do_not_lose(start):
    ladder = Ladder(chart("npl_10"), widest=150)
    win = dict(zip(ladder.errors.tolist(), ladder.wins.tolist(), strict=True))
    total, _ = by_hand(win, start)
    found = newcomer_inflation(ladder, start)
    assert found.brought == start
    assert found.made == pytest.approx(total, abs=1e-9)
    assert found.left == pytest.approx(start + total, abs=1e-9)


def test_newcomers_without_longer_steps_leave_all_that_they_bring():
    assert newcomer_inflation(Ladder(step_system(2)), 20) == (20, 0.0, 20.0)


def test_a_simulated_league_keeps_what_a_newcomer_leaves():
    # One newcomer among rightly rated opponents who stay so: the ladder's own assumption.
    ladder = Ladder(chart("npl_10"))
    found = newcomer_inflation(ladder, -30)
    rng = np.random.default_rng(2)
    error, total = np.full(40_000, -30), np.zeros(40_000)
    for t in range(30):
        step = 3 if t < 10 else 2
        turn = np.where(rng.random(len(error)) < ladder.wins[error + ladder.widest], 1, -1)
        error += turn * step
        total += turn * (step - 1)
    assert abs(total.mean() - found.made) < 4.5 * total.std() / np.sqrt(len(total))


def test_newcomer_refuses_an_error_off_the_ladder():
    with pytest.raises(
        InputError,
        match=(
            "start must be a rating error in whole points from -60 to 60, or make "
            "widest larger; you gave 500"
        ),
    ):
        newcomer_inflation(Ladder("npl"), 500)


@pytest.mark.parametrize("drift", [0.05, 0.1, 0.3, -0.1])
def test_a_rating_moves_on_average_as_fast_as_the_skill(drift):
    ladder = Ladder(chart("npl_10"), drift=drift)
    law = np.array(ladder.law().probability)
    assert law @ (2 * ladder.wins - 1) == pytest.approx(drift, abs=1e-9)
    found = lag(ladder)
    assert found.drift == drift
    assert np.sign(found.mean) == -np.sign(drift)
    assert (found.mean, found.sd) == (ladder.law().mean, ladder.law().sd)


def test_lag_grows_with_the_drift_and_is_none_without():
    lags = [lag(Ladder("npl", drift=drift)).mean for drift in (0.0, 0.02, 0.1, 0.2)]
    assert lags[0] == pytest.approx(0.0, abs=1e-9)
    assert lags == sorted(lags, reverse=True)


def test_a_lag_that_is_simulated_agrees():
    ladder = Ladder("npl", drift=0.1)
    rng = np.random.default_rng(11)
    error, means = np.zeros(4000, dtype=int), []
    for t in range(2200):
        won = rng.random(len(error)) < ladder.wins[error + ladder.widest]
        error += np.where(won, 1, -1) - (rng.random(len(error)) < 0.1)
        if t >= 200:
            means.append(error.mean())
    batches = np.array(means).reshape(10, -1).mean(axis=1)
    assert abs(batches.mean() - lag(ladder).mean) < 4.5 * batches.std(ddof=1) / np.sqrt(10)


def test_a_skill_that_runs_away_has_no_lag():
    with pytest.raises(AccuracyError, match="don't keep up"):
        lag(Ladder("npl", drift=0.99, widest=60))
