import math

import pytest

from evenbreak.answers.fair_pairs import RaceLimits, matchups_frame
from evenbreak.answers.frames import ratings_frame
from evenbreak.answers.sheet_parts import (
    bar_ticks,
    chart_bands,
    player_lines,
    race_blocks,
    sure_pairs,
)
from evenbreak.handicaps.charts.fair import fair_races
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.fit import fit
from evenbreak.ratings.results import Results
from evenbreak.ratings.scale import scale_of

SEASON = Results.from_names(["Ann", "Bo", "Ann"], ["Bo", "Cy", "Cy"], [70, 70, 7], [50, 40, 2])


@pytest.mark.parametrize("scale", ["npl", "fargo", "2"])
@pytest.mark.parametrize("limits", [RaceLimits(race_to=7), RaceLimits(games=(9, 9))])
def test_each_band_has_the_fairest_race_of_every_difference_in_it(scale, limits):
    scale = scale_of(scale)
    furthest = 3.0 * scale.points_per_doubling
    bands = chart_bands(limits, scale, furthest)
    assert bands[0].first == 0.0
    assert bands[-1].after >= furthest
    unit = {"npl": 0.1, "fargo": 1.0}.get(scale.name, 0.01)
    for band, after in zip(bands, [*bands[1:], None], strict=True):
        if after is not None:
            assert band.after == after.first
            assert (band.stronger, band.weaker) != (after.stronger, after.weaker)
        for inside in (band.first, (band.first + band.after) / 2, band.after - unit):
            p = scale.win_probability(inside)
            (race,) = fair_races(p, games=limits.games, race_to=limits.race_to, top=1)
            assert (race.race_1, race.race_2) == (band.stronger, band.weaker)
        p = scale.win_probability(band.first)
        assert band.p_first == race_win_probability(p, band.stronger, band.weaker)


def test_a_pair_at_the_very_edge_is_in_the_band_of_its_race():
    limits, npl = RaceLimits(games=(9, 9)), scale_of("npl")
    edge = chart_bands(limits, npl, 90.0)[1].first
    assert chart_bands(limits, npl, edge)[-1].first == edge


def test_there_is_no_chart_where_lengths_differ_or_of_too_many_lines():
    npl = scale_of("npl")
    assert chart_bands(RaceLimits(games=(7, 13)), npl, 90.0) == []
    assert chart_bands(RaceLimits(race_to=200), npl, 90.0) == []


def test_a_pair_is_as_sure_as_its_difference_with_the_covariance():
    ratings = fit(SEASON)
    paired = matchups_frame(ratings, [0, 1, 2], RaceLimits(race_to=7))
    pairs = sure_pairs(ratings, paired)
    assert [pair.error for pair in pairs] == sorted(pair.error for pair in pairs)
    error = dict(zip(ratings.players, ratings.standard_error, strict=True))
    for pair in pairs:
        wanted = ratings.difference_error(pair.player_a, pair.player_b)
        assert pair.error == pytest.approx(wanted, rel=1e-9)
        assert pair.error < math.hypot(error[pair.player_a], error[pair.player_b])
        assert pair.low < pair.p_win < pair.high
        m, n = map(int, pair.race.split(":"))
        p = ratings.scale.win_probability(pair.difference - 2 * pair.error)
        assert pair.low == race_win_probability(p, m, n)
    row = paired[(paired.player_a == "Ann") & (paired.player_b == "Cy")].iloc[0]
    (pair,) = (pair for pair in pairs if (pair.player_a, pair.player_b) == ("Ann", "Cy"))
    assert pair.p_win == pytest.approx(row.p_win_a, abs=1e-12)


def test_bars_and_marks_share_an_axis():
    ratings = fit(SEASON)
    rated = ratings_frame(ratings)
    lines = player_lines(rated, ratings)
    ticks = bar_ticks(rated)
    assert len(ticks) >= 2
    (first, second) = ticks[:2]
    per_point = (second.at - first.at) / (float(second.label) - float(first.label))
    for line, row in zip(lines, rated.itertuples(), strict=True):
        assert 0 < line.low < line.middle < line.high < 100
        at = first.at + per_point * (row.rating - float(first.label))
        assert line.middle == pytest.approx(at, abs=0.05)
        assert line.high - line.low == pytest.approx(4 * row.standard_error * per_point, abs=0.1)


def test_wide_races_make_narrow_blocks():
    def blocks(to):
        names = [f"P{k:02}" for k in range(40)]
        season = Results.from_names(names, names[1:] + names[:1], [7] * 40, [5] * 40)
        ratings = fit(season)
        paired = matchups_frame(ratings, range(40), RaceLimits(race_to=to))
        lines = player_lines(ratings_frame(ratings), ratings)
        return [len(block.across) for block in race_blocks(lines, paired)]

    assert blocks(7) == [20, 20]
    assert blocks(12) == [14, 14, 12]
