import numpy as np
import pandas as pd
import pytest

from evenbreak.answers.league.roster_matchups import OfferedRaces
from evenbreak.answers.league.sheet import SurePair, chart_bands
from evenbreak.handicaps import Gap
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.scale import SCALES
from evenbreak.sheets.race_blocks import (
    HEIGHT,
    WIDTH,
    Bars,
    evenness_plot,
    parts_of,
    player_lines,
    race_blocks,
    race_cards,
)
from leagues import CLUB, league, sheet_of, two_groups


def lines_of(sheet):
    return player_lines(sheet.rated, sheet.ratings.scale, Bars(sheet.rated), grouped=False)


@pytest.mark.parametrize(("many", "most", "sizes"), [(5, 9, [5]), (25, 24, [13, 12]), (1, 1, [1])])
def test_parts_are_as_equal_as_can_be(many, most, sizes):
    assert [len(part) for part in parts_of(list(range(many)), most)] == sizes


@pytest.mark.parametrize("sheet", [sheet_of(league(5)), sheet_of(two_groups())])
def test_blocks_hold_every_race_once(sheet):
    found = {}
    for block in race_blocks(lines_of(sheet), sheet.races, 2):
        assert len(block.across) <= 2
        for line, races in block.rows:
            for other, race in zip(block.across, races, strict=True):
                found[line.name, other.name] = race
    assert {pair for pair, race in found.items() if race is None} == {
        (name, name) for name in sheet.rated["player"]
    }
    assert {pair: race for pair, race in found.items() if race not in (None, "-")} == sheet.races


def test_wide_races_make_narrow_blocks():
    def blocks(to):
        sheet = sheet_of(league(40), offered=OfferedRaces(race_to=to))
        return [len(block.across) for block in race_blocks(lines_of(sheet), sheet.races)]

    assert blocks(7) == [20, 20]
    assert blocks(12) == [14, 14, 12]


def test_cards_have_each_opponent_with_race_and_chance():
    sheet = sheet_of(league(4))
    chances = {(row.player_a, row.player_b): row.p_win_a for row in sheet.paired.itertuples()}
    chances |= {(b, a): 1 - p for (a, b), p in chances.items()}
    cards = race_cards(lines_of(sheet), sheet.races, sheet.paired)
    found = {
        (card.player.name, other.name): (race, chance)
        for card in cards
        for other, race, chance in card.races
    }
    assert found == {pair: (sheet.races[pair], f"{p:.2f}") for pair, p in chances.items()}


NPL = SCALES["npl"]


def lines_with_bars(rated, *, grouped=False):
    return player_lines(rated, NPL, Bars(rated), grouped=grouped)


def test_bars_and_marks_share_an_axis():
    rated = sheet_of(league(3)).rated
    ticks = Bars(rated).ticks()
    assert len(ticks) >= 2
    (first, second) = ticks[:2]
    per_point = (second.at - first.at) / (float(second.label) - float(first.label))
    for line, row in zip(lines_with_bars(rated), rated.itertuples(), strict=True):
        assert 0 < line.low < line.middle < line.high < 100
        at = first.at + per_point * (row.rating - float(first.label))
        assert line.middle == pytest.approx(at, abs=0.05)
        assert line.high - line.low == pytest.approx(4 * row.standard_error * per_point, abs=0.1)


def test_no_mark_hangs_over_the_edge():
    for spread in (0.0, 1.0, 30.0, 1e4):
        ticks = Bars(pd.DataFrame({"rating": [80, 80 + spread], "standard_error": [0, 0]})).ticks()
        assert all(4 < tick.at < 96 for tick in ticks)
        assert ticks


def test_what_is_not_stated_is_empty():
    rated = pd.DataFrame(
        {
            "player": CLUB.players,
            "rating": CLUB.rating,
            "standard_error": CLUB.standard_error,
            "games": [140, 60, -1, 30],
            "component": 0,
            "provisional": CLUB.provisional,
        }
    )
    ann, _, cy, _ = lines_with_bars(rated)
    assert (ann.rating, ann.error, ann.games, ann.won, ann.group) == ("92", "5.0", 140, None, None)
    assert (cy.error, cy.games) == ("", None)
    assert cy.low == cy.middle == cy.high


def test_a_group_is_shown_on_demand():
    rated = sheet_of(league(2)).rated.assign(component=[1, 2])
    assert [line.group for line in lines_with_bars(rated, grouped=True)] == [1, 2]
    assert np.all([line.won is not None for line in lines_with_bars(rated)])


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
