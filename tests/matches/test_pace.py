import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.matches.pace import PACES, Pace, Turnover, own_pace, pace_of

TIMED = [
    ("9-ball", {4: 25.1, 5: 30.9, 6: 36.7, 7: 42.5}, 0.05),
    ("8-ball", {2: 24.1, 3: 34.2, 4: 40.4, 5: 49.2, 6: 54.8}, 0.15),
    ("10-ball", {4: 30.0, 5: 35.3, 6: 42.2, 7: 49.8}, 0.05),
]
"""Mean minutes of 74,755 timed matches by games played. Longer ones are played by stronger, faster
players: at 9-ball 13 games took 64 minutes, 16% less than the pace says."""


@pytest.mark.parametrize(("discipline", "minutes", "within"), TIMED)
def test_the_usual_paces_are_those_of_timed_matches(discipline, minutes, within):
    pace = pace_of(discipline)
    assert pace.mean_minutes(list(minutes)) == pytest.approx(list(minutes.values()), rel=within)


def test_matches_vary_as_timed_matches_do():
    # 9-ball of 7 games: 42.5 minutes, standard deviation 12.4.
    assert np.sqrt(np.expm1(PACES["9-ball"].log_sd ** 2)) == pytest.approx(12.4 / 42.5, rel=0.05)


def test_what_is_drawn_has_the_mean_and_the_spread():
    rng, pace = np.random.default_rng(1), PACES["8-ball"]
    drawn = pace.draw(np.full(100_000, 7), rng)
    assert drawn.mean() == pytest.approx(pace.mean_minutes(7), rel=4 * 0.32 / 100_000**0.5)
    assert np.log(drawn).std() == pytest.approx(pace.match_sd, rel=0.01)
    assert pace.draw(0, rng) == 0.0


def test_the_usual_turnover_has_the_median_and_the_mean_of_timed_ones():
    drawn = Turnover().draw(100_000, np.random.default_rng(1))
    assert np.median(drawn) == pytest.approx(7.5, rel=0.02)
    assert drawn.mean() == pytest.approx(10.8, rel=0.02)
    assert not Turnover(0.0).draw(3, np.random.default_rng(1)).any()


def test_own_minutes_a_game_are_all_that_a_match_takes():
    assert own_pace(8.0).mean_minutes(9) == 72.0


@pytest.mark.parametrize(
    ("call", "named"),
    [
        (lambda: pace_of("snooker"), "snooker"),
        (lambda: Pace(0, 0, 0, 0), "per_game"),
        (lambda: Pace(-1, 5, 0, 0), "overhead"),
        (lambda: Pace(0, 5, float("nan"), 0), "match_sd"),
        (lambda: Turnover(-1), "mean"),
    ],
)
def test_refused(call, named):
    with pytest.raises(InputError, match=named):
        call()
