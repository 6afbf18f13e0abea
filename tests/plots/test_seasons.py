"""Pictures of simulated seasons: what is on them, for small leagues and large ones."""

import numpy as np

from evenbreak.answers.league.season_tables import season_tables
from evenbreak.league import FixedSchedule, LeaguePlayers, Season, run_chunk
from evenbreak.plots.league import draw_errors, draw_gaps, draw_standings
from evenbreak.plots.picture import image_bytes


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
    assert axes.get_title().endswith("the first and the last 20 of 100")


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
