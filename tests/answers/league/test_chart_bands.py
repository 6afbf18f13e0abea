import pytest

from evenbreak.answers.league.roster_matchups import OfferedRaces
from evenbreak.answers.league.sheet import chart_bands
from evenbreak.handicaps import Gap
from evenbreak.handicaps.charts.fair import fair_races
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.scale import scale_of

EVEN = Gap(0.0)


@pytest.mark.parametrize("scale", ["npl", "fargo", "2"])
@pytest.mark.parametrize("offered", [OfferedRaces(race_to=7), OfferedRaces(games=(9, 9))])
def test_each_band_has_the_fairest_race_of_every_difference_in_it(scale, offered):
    scale = scale_of(scale)
    furthest = 3.0 * scale.points_per_doubling
    bands = chart_bands(offered, Gap(0.0, scale=scale), furthest)
    assert bands[0].first == 0.0
    assert bands[-1].after >= furthest
    unit = {"npl": 0.1, "fargo": 1.0}.get(scale.name, 0.01)
    for band, after in zip(bands, [*bands[1:], None], strict=True):
        if after is not None:
            assert band.after == after.first
            assert (band.stronger, band.weaker) != (after.stronger, after.weaker)
        for inside in (band.first, (band.first + band.after) / 2, band.after - unit):
            p = scale.win_probability(inside)
            (race,) = fair_races(p, games=offered.games, race_to=offered.race_to, top=1)
            assert (race.race_1, race.race_2) == (band.stronger, band.weaker)
        p = scale.win_probability(band.first)
        assert band.p_first == race_win_probability(p, band.stronger, band.weaker)


def test_a_pair_at_the_very_edge_is_in_the_band_of_its_race():
    offered = OfferedRaces(games=(9, 9))
    edge = chart_bands(offered, EVEN, 90.0)[1].first
    assert chart_bands(offered, EVEN, edge)[-1].first == edge


def test_there_is_no_chart_where_lengths_differ_or_of_too_many_lines():
    assert chart_bands(OfferedRaces(games=(7, 13)), EVEN, 90.0) == []
    assert chart_bands(OfferedRaces(race_to=200), EVEN, 90.0) == []
