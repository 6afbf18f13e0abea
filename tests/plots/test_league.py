"""Pictures of simulated seasons: what is on them, for small leagues and large ones."""

import numpy as np
import pytest

from evenbreak.answers.league.season_tables import season_tables
from evenbreak.handicaps import Ladder
from evenbreak.league import FixedSchedule, LeaguePlayers, Season, Watched, run_chunk, sandbagging
from evenbreak.plots.league import (
    MOST_NAMED,
    draw_calibration,
    draw_errors,
    draw_gaps,
    draw_pay,
    draw_standings,
    draw_watch,
)
from evenbreak.plots.picture import image_bytes
from evenbreak.ratings import Results, validate


def seasons(season, replicas=40):
    one, two = np.random.SeedSequence(1).spawn(2)
    return season_tables(
        season, run_chunk(season, replicas, one) + run_chunk(season, replicas, two)
    )


def test_errors_are_drawn_week_by_week():
    players = LeaguePlayers.of([90, 70, 60, 50], skill=[80, 80, 60, 55])
    weeks = seasons(Season(players, "npl", weeks=6)).weeks
    axes = draw_errors(weeks)
    lines = {line.get_label(): line.get_ydata() for line in axes.lines}
    assert np.allclose(lines["standard deviation"], weeks["error_sd"])
    assert axes.get_xlim() == (0.0, 6.0)


def test_wins_are_drawn_by_gap():
    frame = seasons(Season(LeaguePlayers.of([110, 80, 60, 50]), "npl", weeks=6)).fairness
    axes = draw_gaps(frame)
    drawn = axes.containers[0].lines[0].get_ydata()
    assert np.allclose(drawn, frame[frame["group"] == "gap"]["p_win"])
    assert image_bytes(draw_gaps(frame), "png")[1:4] == b"PNG"


def test_the_table_is_drawn_and_of_a_large_league_its_ends():
    standings = seasons(Season(LeaguePlayers.of([80] * 5), "npl", weeks=2)).standings
    names = [text.get_text() for text in draw_standings(standings).get_yticklabels()]
    assert sorted(names) == [f"player {k}" for k in range(1, 6)]
    standings = seasons(Season(LeaguePlayers.of([80] * 100), "npl", weeks=2), 2).standings
    axes = draw_standings(standings)
    assert len(axes.get_yticklabels()) == 40
    assert axes.get_title().endswith("the first 20 and the last 20 of 100")


def test_the_key_of_the_table_covers_nobody():
    axes = draw_standings(seasons(Season(LeaguePlayers.of([80] * 20), "npl", weeks=2)).standings)
    axes.figure.draw_without_rendering()
    (key,) = axes.figure.legends
    assert [text.get_text() for text in key.get_texts()] == ["8 seasons in 10", "mean"]
    assert key.get_window_extent().y1 <= axes.get_tightbbox().y0


def test_of_one_season_the_table_shows_no_spread():
    season = Season(LeaguePlayers.of([80] * 4), "npl", weeks=2)
    tally = run_chunk(season, 1, np.random.SeedSequence(1))
    axes = draw_standings(season_tables(season, tally).standings)
    assert [text.get_text() for text in axes.figure.legends[0].get_texts()] == ["mean"]


def test_a_season_without_matches_is_drawn_empty():
    season = Season(
        LeaguePlayers.of([80, 70], joins=[1, 9]), "npl", None, FixedSchedule([1], [0], [1]), weeks=2
    )
    tables = seasons(season, 3)
    for axes in (
        draw_errors(tables.weeks),
        draw_gaps(tables.fairness),
        draw_standings(tables.standings),
    ):
        assert image_bytes(axes, "svg").startswith(b"<?xml")


# Pictures of sandbagging show the lines that they say.


def test_each_line_is_the_chance_to_win():
    pays = sandbagging(Ladder("npl"), dumped=4, earnest=6)
    axes = draw_pay(pays)
    assert len(axes.lines) == 5
    for dumped, line in enumerate(axes.lines):
        assert list(line.get_ydata()) == pays.p_win[dumped].tolist()


def test_the_most_suspicious_are_named_and_all_are_drawn():
    rows = np.arange(2)
    watched = [
        Watched(f"p{k}", rows, rows > 0, np.array([0.0, k]), np.array([0.0, 0.0]), "any", 0.05)
        for k in range(MOST_NAMED + 3)
    ]
    axes = draw_watch(watched, alpha=0.05)
    assert len(axes.lines) == 1 + len(watched)
    names = [text.get_text() for text in axes.get_legend().get_texts()]
    assert names == ["alarm", *(f"p{k}" for k in range(MOST_NAMED + 2, 2, -1))]
    assert axes.lines[0].get_ydata()[0] == 20.0


def test_dollars_in_a_name_are_not_set_as_a_formula():
    rows, e = np.arange(1), np.zeros(1)
    axes = draw_watch([Watched("$x$", rows, rows > 0, e, e, "any", 0.01)], alpha=0.01)
    assert not axes.get_legend().get_texts()[1].get_parse_math()


# The picture of a validated season.


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
    assert line.get_ydata().tolist() == [row.seen for row in found.games if row.games >= 20]


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
