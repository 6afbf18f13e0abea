"""Which chart a league plays by."""

import dataclasses

import numpy as np
import pytest

from evenbreak.handicaps import level_chart
from evenbreak.handicaps.charts.played_chart import played_chart
from handicapped import by_chart, by_class

CHANGED = {(5, 3): (6, 4), (6, 3): (7, 4), (7, 2): (8, 2)}


@pytest.mark.parametrize("levels", [True, False], ids=["ratings", "races alone"])
@pytest.mark.parametrize("name", ["npl_10", "npl_20", "fargo_r6_hot"])
def test_a_chart_of_the_catalog_is_recognized(name, levels):
    found = played_chart(by_chart(1, name=name, levels=levels, matches=400))
    if name == "fargo_r6_hot" and not levels:
        assert found is None  # ratings 25 points apart play but three of its races
        return
    assert (found.name, found.agree) == (name, found.matches)
    assert all(cell.played is None for cell in found.changed)
    assert found.same is (levels or not found.changed)


def test_changed_cells_are_named():
    found = played_chart(by_chart(2, instead=CHANGED, matches=800))
    assert (found.name, found.by, found.cells) == ("npl_10", "rating", 8)
    assert {cell.chart: cell.played for cell in found.changed} == CHANGED
    assert found.changed[0].where == "22 to 28 points apart"
    assert found.agree == found.matches - sum(cell.matches for cell in found.changed)


def test_slips_of_the_pen_change_no_cell():
    season = by_chart(2, matches=400)
    race_a = season.race_a.copy()
    race_a[:3] += 1
    found = played_chart(dataclasses.replace(season, race_a=race_a))
    assert (found.agree, found.changed) == (397, ())


def test_changed_races_are_seen_without_ratings():
    found = played_chart(by_chart(2, instead=CHANGED, levels=False, matches=800))
    assert (found.name, found.by) == ("npl_10", "race")
    assert {cell.chart for cell in found.changed} - {None} == {(5, 3), (6, 3), (7, 2)}
    assert {cell.played for cell in found.changed} - {None} == {(7, 4), (8, 2)}


def test_skill_levels_are_compared_pair_by_pair():
    rng = np.random.default_rng(3)
    a, b = rng.integers(2, 8, (2, 400))
    race_a, race_b = (race.copy() for race in level_chart("apa_8ball").races(a, b))
    race_a[(a == 5) & (b == 3)] = 5
    race_b[(b == 5) & (a == 3)] = 5
    season = dataclasses.replace(
        by_class(1, matches=400), race_a=race_a, race_b=race_b,
        level_a=a.astype(str).astype(object), level_b=b.astype(str).astype(object),
    )  # fmt: skip
    found = played_chart(season)
    assert (found.name, found.by) == ("apa_8ball", "level")
    (cell,) = found.changed
    assert (cell.where, cell.chart, cell.played) == ("level 5 against 3", (4, 2), (5, 2))


def test_starts_by_class_are_no_chart_of_the_catalog():
    assert played_chart(by_class(1, matches=400)) is None
    assert played_chart(by_class(1, matches=400, named=False)) is None
