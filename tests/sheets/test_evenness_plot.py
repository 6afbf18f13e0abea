import pytest

from evenbreak.answers.league.roster_matchups import OfferedRaces
from evenbreak.answers.league.sheet import SurePair, chart_bands
from evenbreak.handicaps import Gap
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.scale import scale_of
from evenbreak.sheets.race_blocks import HEIGHT, WIDTH, evenness_plot

NPL = scale_of("npl")
EVEN = Gap(0.0)


def pair(difference, m, n):
    p = race_win_probability(NPL.win_probability(difference), m, n)
    return SurePair("Ann", "Bo", f"{m}:{n}", difference, 9.0, p, 0.0, 1.0)


def test_pairs_lie_on_the_curve_of_their_race_and_all_is_in_the_box():
    bands = chart_bands(OfferedRaces(race_to=7), EVEN, 60.0)
    pairs = [pair((band.first + band.after) / 2, band.stronger, band.weaker) for band in bands]
    plot = evenness_plot(bands, pairs, EVEN)
    curves = [[tuple(map(float, p.split(","))) for p in c.split()] for c in plot.curves]
    for curve, dot in zip(curves, plot.dots, strict=True):
        assert curve[len(curve) // 2] == pytest.approx(dot, abs=0.01)
        assert [y for _, y in curve] == sorted((y for _, y in curve), reverse=True)
    for x, y in [point for curve in curves for point in curve] + list(plot.dots):
        assert plot.left <= x <= plot.right < WIDTH
        assert plot.top <= y <= plot.bottom < HEIGHT


def test_half_is_marked_in_the_middle():
    plot = evenness_plot([], [pair(10.0, 7, 6)], EVEN)
    (half,) = (tick.at for tick in plot.y if tick.label == "0.5")
    assert half == pytest.approx((plot.top + plot.bottom) / 2)


def test_equal_players_alone_can_be_drawn():
    bands = chart_bands(OfferedRaces(race_to=7), EVEN, 0.0)
    plot = evenness_plot(bands, [pair(0.0, 7, 7)], EVEN)
    assert plot.dots == [(plot.left, (plot.top + plot.bottom) / 2)]
    assert evenness_plot([], [pair(0.0, 7, 7)], EVEN).dots[0][0] == plot.left
