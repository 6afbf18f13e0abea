import numpy as np
import pytest
from scipy import integrate, stats

from evenbreak.matches.minutes import match_minutes, mean_up_to
from evenbreak.matches.pace import PACES, Pace

GAMES, CHANCES = [4, 5, 7], np.array([0.5, 0.3, 0.2])


def test_a_match_is_a_mixture_of_lognormals():
    pace = PACES["8-ball"]
    minutes = match_minutes(GAMES, CHANCES, pace)
    s = np.hypot(0.305, 0.128)
    parts = [stats.lognorm(s, scale=(3.8 + 9.82 * k) * np.exp(-(s**2) / 2)) for k in GAMES]
    for t in (30.0, 55.0, 110.0):
        assert minutes.cdf(t) == pytest.approx(sum(CHANCES * [part.cdf(t) for part in parts]))
    assert minutes.mean == pytest.approx(sum(CHANCES * [part.mean() for part in parts]))
    square = sum(CHANCES * [part.moment(2) for part in parts])
    assert minutes.sd == pytest.approx(np.sqrt(square - minutes.mean**2))


@pytest.mark.parametrize("q", [0.01, 0.5, 0.9, 0.999])
def test_a_quantile_is_where_the_chance_is_reached(q):
    minutes = match_minutes(GAMES, np.array([CHANCES, CHANCES[::-1]]), PACES["9-ball"])
    assert minutes.cdf(minutes.quantile(q)) == pytest.approx([q, q], abs=1e-9)


def test_without_spread_it_is_the_games():
    minutes = match_minutes(GAMES, CHANCES, Pace(1.0, 10.0, 0.0, 0.0))
    assert [minutes.quantile(q) for q in (0.5, 0.8, 0.9)] == pytest.approx([41.0, 51.0, 71.0])
    assert match_minutes([0], [1.0], Pace(1.0, 10.0, 0.3, 0.0)).quantile(0.9) == pytest.approx(
        0.0, abs=1e-6
    )


def test_the_mean_cut_off_is_the_integral_of_the_tail():
    time = stats.lognorm(0.3, scale=40 * np.exp(-0.045))
    for t in (20.0, 40.0, 90.0):
        assert mean_up_to(t, 40.0, 0.3) == pytest.approx(integrate.quad(time.sf, 0, t)[0])
