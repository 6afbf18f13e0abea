import numpy as np
import pytest
from scipy import integrate, stats

from evenbreak.matches import minutes
from evenbreak.matches.minutes import all_at_once, match_minutes, mean_up_to, one_after_another
from evenbreak.matches.pace import PACES, Pace, Turnover
from evenbreak.matches.races import race_odds

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


def lengths(count):
    race = race_odds(7, 5, 0.55)
    return [np.bincount(race.games, race.probability)] * count


def p90(end):
    return float(np.interp(0.9, end.ended, end.minutes))


@pytest.mark.parametrize("matches", [1, 3, 100])
def test_a_grid_four_times_as_fine_changes_nothing(monkeypatch, matches):
    coarse = one_after_another(lengths(matches), PACES["9-ball"], Turnover())
    many = all_at_once(lengths(matches), PACES["9-ball"])
    monkeypatch.setattr(minutes, "_STEPS_PER_SD", 2000)
    monkeypatch.setattr(minutes, "_MOST_STEPS", 2**20)
    fine = one_after_another(lengths(matches), PACES["9-ball"], Turnover())
    assert p90(coarse) == pytest.approx(p90(fine), abs=0.02)
    assert p90(many) == pytest.approx(p90(all_at_once(lengths(matches), PACES["9-ball"])), abs=0.02)


def test_mean_and_spread_on_the_grid_are_those_of_the_sum():
    end = one_after_another(lengths(5), PACES["9-ball"], Turnover())
    chance = np.diff(end.ended, prepend=0.0)
    middle = end.minutes - (end.minutes[1] - end.minutes[0]) / 2
    assert middle @ chance == pytest.approx(end.mean, abs=1e-3)
    assert np.sqrt((middle - end.mean) ** 2 @ chance) == pytest.approx(end.sd, abs=1e-2)


def test_the_last_of_some_coins():
    """Of two matches of one or two games, three in four evenings last two games."""
    end = all_at_once([np.array([0.0, 0.5, 0.5])] * 2, Pace(0.0, 10.0, 0.0, 0.0))
    assert end.mean == pytest.approx(17.5, abs=0.05)
    assert np.interp([15.0, 25.0], end.minutes, end.ended) == pytest.approx([0.25, 1.0])
