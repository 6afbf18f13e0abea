import numpy as np
import pytest

from evenbreak.matches import minutes as table_time
from evenbreak.matches.minutes import all_at_once, one_after_another
from evenbreak.matches.pace import PACES, Pace, Turnover
from evenbreak.matches.races import race_odds


def lengths(count):
    race = race_odds(7, 5, 0.55)
    return [np.bincount(race.games, race.probability)] * count


def p90(end):
    return float(np.interp(0.9, end.ended, end.minutes))


@pytest.mark.parametrize("matches", [1, 3, 100])
def test_a_grid_four_times_as_fine_changes_nothing(monkeypatch, matches):
    coarse = one_after_another(lengths(matches), PACES["9-ball"], Turnover())
    many = all_at_once(lengths(matches), PACES["9-ball"])
    monkeypatch.setattr(table_time, "_STEPS_PER_SD", 2000)
    monkeypatch.setattr(table_time, "_MOST_STEPS", 2**20)
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
