import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.games import Race, Rack
from evenbreak.handicaps import (
    EQUAL_SKILL,
    NATURAL,
    Ladder,
    chart,
    compare_systems,
    mean_games,
    settling,
)
from evenbreak.handicaps.ladders.comparison import on_front
from evenbreak.handicaps.systems.elo import elo_system
from evenbreak.handicaps.systems.step import step_system
from evenbreak.matches import match_length


def test_rows_are_what_each_function_says():
    by = chart("npl_10")
    (row,) = compare_systems([("npl", by)])
    ladder = Ladder("npl", by, opponents=EQUAL_SKILL)
    settled = settling(ladder, -30, 5)
    assert (row.system, row.chart) == ("npl", "npl_10")
    assert row.sd == ladder.law().sd == pytest.approx(4.417, abs=5e-4)
    assert row.sd_doublings == row.sd / 30
    assert (row.settling_mean, row.settling_p90) == (settled.mean, settled.matches.quantile(0.9))
    assert row.games == mean_games(ladder)
    assert row.inflation == pytest.approx(0.0, abs=1e-12)
    assert 0.5 < row.favorite < 0.6
    assert 0.0 < row.clear_favorite < 1.0


def test_longer_charts_are_slower_to_play_and_better():
    rows = compare_systems([("npl", chart(f"npl_{n}")) for n in (8, 10, 12, 20)])
    for better, worse in zip(rows[1:], rows, strict=False):
        assert better.sd < worse.sd
        assert better.settling_mean < worse.settling_mean
        assert better.games > worse.games


def test_systems_by_name_by_value_and_with_their_own_charts():
    rows = compare_systems(["npl", step_system(2), elo_system(16), (step_system(2, 1), None)])
    assert [row.system for row in rows] == ["npl", "step 2", "elo 16", "step 2 1"]
    assert rows[-1].inflation == pytest.approx(1.0)
    assert rows[2].sd_doublings == pytest.approx(rows[2].sd / 120.41, rel=1e-4)


def test_forms_are_told_in_doublings_on_every_scale():
    with_form, by_points = (
        compare_systems(["npl"], opponents=NATURAL, day_sd=0.2)[0],
        Ladder("npl", day_sd=6.0),
    )
    assert with_form.sd == by_points.law().sd


def test_mean_games_are_those_of_each_race_at_the_natural_law():
    ladder = Ladder(chart("npl_12"))
    law = zip(ladder.law().values, ladder.law().probability, strict=True)
    expected = sum(
        chance * match_length(Race(*ladder.chart.race(i), Rack(0.5))).mean for i, chance in law
    )
    assert mean_games(ladder) == pytest.approx(expected, rel=1e-12)


def test_longer_steps_are_faster_and_worse_so_all_are_on_the_front():
    rows = compare_systems([step_system(step) for step in range(1, 6)])
    assert all(on_front([(row.sd, row.settling_mean) for row in rows]))
    assert (np.diff([row.sd for row in rows]) > 0).all()
    assert (np.diff([row.settling_mean for row in rows]) < 0).all()


def test_a_point_that_another_beats_is_not_on_the_front():
    good, bad, slow = (4.0, 60.0), (5.0, 60.0), (3.0, 70.0)
    assert on_front([good, bad, slow]) == [True, False, True]
    assert on_front([good, good]) == [True, True]


def test_nonsense_is_refused():
    with pytest.raises(
        InputError,
        match=(
            r"system must be npl, step UP \[DOWN\], margin \[MOST\], elo \[K\], fixed "
            r"\[GAMES\], none \[GAMES\], fargo-like, level-review, apa-like, tap-like, "
            r"level-steps \[STEPS\], averages, win-percent or napa-like; you gave "
            r"'nothing'"
        ),
    ):
        compare_systems(["nothing"])
