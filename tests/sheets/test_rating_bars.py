import numpy as np
import pandas as pd
import pytest

from evenbreak.ratings.scale import SCALES
from evenbreak.sheets.race_blocks import Bars, player_lines
from leagues import CLUB, league, sheet_of

NPL = SCALES["npl"]


def lines_of(rated, *, grouped=False):
    return player_lines(rated, NPL, Bars(rated), grouped=grouped)


def test_bars_and_marks_share_an_axis():
    rated = sheet_of(league(3)).rated
    ticks = Bars(rated).ticks()
    assert len(ticks) >= 2
    (first, second) = ticks[:2]
    per_point = (second.at - first.at) / (float(second.label) - float(first.label))
    for line, row in zip(lines_of(rated), rated.itertuples(), strict=True):
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
        }
    )
    ann, _, cy, _ = lines_of(rated)
    assert (ann.rating, ann.error, ann.games, ann.won, ann.group) == ("92", "5.0", 140, None, None)
    assert (cy.error, cy.games) == ("", None)
    assert cy.low == cy.middle == cy.high


def test_a_group_is_shown_on_demand():
    rated = sheet_of(league(2)).rated.assign(component=[1, 2])
    assert [line.group for line in lines_of(rated, grouped=True)] == [1, 2]
    assert np.all([line.won is not None for line in lines_of(rated)])
