"""The picture of a validated season."""

import pytest

from evenbreak.plots.league import draw_calibration
from evenbreak.ratings import Results, validate


def season(**columns):
    return Results.from_names(
        ["Ann"] * 4, ["Bo"] * 4, [7, 7, 3, 7], [2, 4, 7, 5],
        date=[f"2024-09-0{day}" for day in range(3, 7)], **columns,
    )  # fmt: skip


@pytest.fixture
def axes():
    return lambda results: draw_calibration(validate(results, prior_sd=0.5))


def test_each_kind_of_prediction_is_drawn_with_its_bars(axes):
    one = axes(season())
    names = [text.get_text() for text in one.get_legend().get_texts()]
    assert len(names) == 4  # the diagonal, games, matches and matches at face value
    assert len(one.containers) == 3


def test_points_are_where_the_bins_are():
    found = validate(season(), prior_sd=0.5)
    line = draw_calibration(found).containers[0].lines[0]
    assert line.get_ydata().tolist() == [row.seen for row in found.games]


def test_without_races_there_are_games_only(axes):
    drawn = Results.from_names(
        ["Ann"] * 3, ["Bo"] * 3, [5, 5, 4], [5, 3, 4],
        date=["2024-09-03", "2024-09-04", "2024-09-05"],
    )  # fmt: skip
    assert len(axes(drawn).containers) == 1


def test_the_whole_of_every_bar_is_in_sight(axes):
    one = axes(season())
    low, high = one.get_ylim()
    assert low >= 0.0
    assert high > 1.0
