import numpy as np
import pytest

from evenbreak.errors import AccuracyError, InputError
from evenbreak.handicaps import EQUAL_SKILL, Ladder, Settling, chart, settling
from evenbreak.handicaps.systems.step import step_system


def dense_mean(ladder, start, within):
    """Return the mean first passage into the band from (I - Q) t = 1."""
    errors, win = ladder.errors, ladder.wins
    n = len(errors)
    matrix = np.zeros((n, n))
    for place in range(n):
        matrix[place, min(place + 1, n - 1)] += win[place]
        matrix[place, max(place - 1, 0)] += 1 - win[place]
    out = np.abs(errors) > within
    left = np.linalg.solve(np.eye(out.sum()) - matrix[np.ix_(out, out)], np.ones(out.sum()))
    return left[list(errors[out]).index(start)]


@pytest.mark.parametrize("name", ["npl_8", "npl_10", "npl_12", "npl_20"])
@pytest.mark.parametrize("start", [-30, 17])
def test_mean_is_that_of_the_linear_equations(name, start):
    ladder = Ladder(chart(name))
    found = settling(ladder, start)
    assert found.mean == pytest.approx(dense_mean(ladder, start, 5), rel=1e-9)


def test_chances_mean_and_tail_belong_together():
    found = settling(Ladder("npl"), 30)
    assert isinstance(found, Settling)
    assert sum(found.chances) + found.tail == pytest.approx(1.0, abs=1e-13)
    assert 0.0 <= found.tail <= 1e-12
    assert found.matches.mean == pytest.approx(found.mean, abs=1e-6)
    assert found.matches.sd == pytest.approx(found.sd, abs=1e-5)
    assert found.chances[:25] == (0.0,) * 25  # 25 points cannot be made good in fewer matches
    assert found.after(24) == 0.0
    assert found.after(25) == found.chances[25] > 0.0
    assert found.after(10**6) == pytest.approx(1.0)
    q90 = found.matches.quantile(0.9)
    assert found.after(q90) >= 0.9 > found.after(q90 - 1)


def test_over_and_underrated_settle_alike():
    ladder = Ladder("npl", opponents=EQUAL_SKILL)
    up, down = settling(ladder, 20), settling(ladder, -20)
    np.testing.assert_allclose(up.chances, down.chances, atol=1e-13)


@pytest.mark.parametrize("start", [-5, 0, 5])
def test_a_start_in_the_band_is_settled(start):
    found = settling(Ladder("npl"), start, newcomer=True)
    assert (found.mean, found.sd, found.chances, found.tail) == (0.0, 0.0, (1.0,), 0.0)
    assert found.matches.values == (0,)


def by_hand(win, start, within, schedule, horizon):
    """Return P(settled at t), following each error through its first matches."""
    law, chances = {start: 1.0}, [0.0]
    for t in range(horizon):
        step = next((f for last, f in schedule if t < last), 1)
        after, settled = {}, 0.0
        for error, chance in law.items():
            for move, p in ((step, win(error)), (-step, 1 - win(error))):
                if abs(error + move) <= within:
                    settled += chance * p
                else:
                    after[error + move] = after.get(error + move, 0.0) + chance * p
        law = after
        chances.append(settled)
    return chances


@pytest.mark.parametrize("start", [-30, -12, 23])
def test_newcomers_move_by_three_then_two_then_one(start):
    ladder = Ladder(chart("npl_10"), widest=160)
    wins = dict(zip(ladder.errors.tolist(), ladder.wins.tolist(), strict=True))
    expected = by_hand(wins.__getitem__, start, 5, ((10, 3), (30, 2)), 60)
    found = settling(ladder, start, newcomer=True)
    np.testing.assert_allclose(found.chances[:61], expected, atol=1e-14)
    tail = 1 - sum(found.chances[:31])
    assert 0 < tail < 1
    assert found.matches.mean == pytest.approx(found.mean, abs=1e-6)
    assert found.mean < settling(ladder, start).mean


def test_a_simulation_of_newcomers_agrees():
    ladder = Ladder(chart("npl_10"))
    found = settling(ladder, -30, newcomer=True)
    rng = np.random.default_rng(8)
    error, taken = np.full(20_000, -30), np.zeros(20_000)
    for t in range(400):
        away = np.abs(error) > 5
        step = 3 if t < 10 else 2 if t < 30 else 1
        won = rng.random(len(error)) < ladder.wins[error + ladder.widest]
        error = np.where(away, error + np.where(won, step, -step), error)
        taken += away
    assert abs(taken.mean() - found.mean) < 4.5 * found.sd / np.sqrt(len(taken))


def test_drift_of_the_skill_is_not_multiplied_by_the_newcomers_factor():
    ladder = Ladder(chart("npl_10"), drift=0.25)
    wins = dict(zip(ladder.errors.tolist(), Ladder(chart("npl_10")).wins.tolist(), strict=True))
    first = {-12 + 3 - 1: 0.25, -12 + 3: 0.75, -12 - 3 - 1: 0.25, -12 - 3: 0.75}
    win = wins[-12]
    expected = sum(
        chance * (win if error > -12 else 1 - win) for error, chance in first.items() if error >= -9
    )
    found = settling(ladder, -12, within=9, newcomer=True)
    assert found.chances[1] == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize(
    ("arguments", "options", "message"),
    [
        (
            (61,),
            {},
            (
                "start must be a rating error in whole points from -60 to 60, or make "
                "widest larger; you gave 61"
            ),
        ),
        (
            (0.5,),
            {},
            (
                r"start must be a rating error in whole points from -60 to 60, or make "
                r"widest larger; you gave 0\.5"
            ),
        ),
        (
            ("x",),
            {},
            (
                "start must be a rating error in whole points from -60 to 60, or make "
                "widest larger; you gave 'x'"
            ),
        ),
        ((30, -1), {}, "within must be a whole number, 0 or more; you gave -1"),
    ],
)
def test_nonsense_is_refused(arguments, options, message):
    with pytest.raises(InputError, match=message):
        settling(Ladder("npl", widest=60), *arguments, **options)


def test_a_newcomer_of_a_system_without_a_schedule_is_refused():
    with pytest.raises(InputError, match="step 2"):
        settling(Ladder(step_system(2)), 30, newcomer=True)


def test_steps_that_jump_over_the_band_may_never_settle():
    with pytest.raises(InputError, match="may never get that small"):
        settling(Ladder(step_system(4)), 30, within=0)


@pytest.mark.slow
def test_what_takes_ages_is_refused():
    # The skill falls about as fast as the rating can follow.
    with pytest.raises(AccuracyError, match="more than 100,000 matches on average"):
        settling(Ladder("npl", widest=60, drift=-0.97), 60, within=0)
