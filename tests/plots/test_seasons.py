"""Pictures of simulated seasons: what is on them, for small leagues and large ones."""

import numpy as np

from evenbreak.answers.season_frames import fairness_frame, weeks_frame
from evenbreak.league import FixedSchedule, LeaguePlayers, Season, run_chunk
from evenbreak.plots.diagram import image_bytes
from evenbreak.plots.seasons import errors_figure, gaps_figure, standings_figure


def seasons(season, replicas=40):
    one, two = np.random.SeedSequence(1).spawn(2)
    return season, run_chunk(season, replicas, one) + run_chunk(season, replicas, two)


def test_errors_are_drawn_week_by_week():
    players = LeaguePlayers.of([90, 70, 60, 50], skill=[80, 80, 60, 55])
    _, tally = seasons(Season(players, "npl", weeks=6))
    axes = errors_figure(tally).axes[0]
    lines = {line.get_label(): line.get_ydata() for line in axes.lines}
    assert np.allclose(lines["one sd"], weeks_frame(tally)["error_sd"])
    assert axes.get_xlim() == (0.0, 6.0)


def test_wins_are_drawn_by_gap():
    season, tally = seasons(Season(LeaguePlayers.of([110, 80, 60, 50]), "npl", weeks=6))
    axes = gaps_figure(season, tally).axes[0]
    frame = fairness_frame(season, tally)
    drawn = axes.containers[0].lines[0].get_ydata()
    assert np.allclose(drawn, frame[frame["group"] == "gap"]["p_win"])
    assert image_bytes(gaps_figure(season, tally), "png")[1:4] == b"PNG"


def test_the_table_is_drawn_and_of_a_large_league_its_ends():
    season, tally = seasons(Season(LeaguePlayers.of([80] * 5), "npl", weeks=2))
    names = [text.get_text() for text in standings_figure(season, tally).axes[0].get_yticklabels()]
    assert sorted(names) == [f"player {k}" for k in range(1, 6)]
    season, tally = seasons(Season(LeaguePlayers.of([80] * 100), "npl", weeks=2), 2)
    axes = standings_figure(season, tally).axes[0]
    assert len(axes.get_yticklabels()) == 40
    assert axes.get_title().endswith("the first and the last 20 of 100")


def test_the_key_of_the_table_covers_nobody():
    season, tally = seasons(Season(LeaguePlayers.of([80] * 20), "npl", weeks=2))
    figure = standings_figure(season, tally)
    figure.draw_without_rendering()
    (key,) = figure.legends
    assert [text.get_text() for text in key.get_texts()] == ["8 seasons in 10", "mean"]
    assert key.get_window_extent().y1 <= figure.axes[0].get_tightbbox().y0


def test_of_one_season_the_table_shows_no_spread():
    season = Season(LeaguePlayers.of([80] * 4), "npl", weeks=2)
    figure = standings_figure(season, run_chunk(season, 1, np.random.SeedSequence(1)))
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["mean"]


def test_a_season_without_matches_is_drawn_empty():
    season = Season(
        LeaguePlayers.of([80, 70], joins=[1, 9]), "npl", None, FixedSchedule([1], [0], [1]), weeks=2
    )
    _, tally = seasons(season, 3)
    for figure in (
        errors_figure(tally),
        gaps_figure(season, tally),
        standings_figure(season, tally),
    ):
        assert image_bytes(figure, "svg").startswith(b"<?xml")
