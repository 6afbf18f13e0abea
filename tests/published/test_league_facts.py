"""Examples of handicap systems as leagues and operators publish them."""

import numpy as np
import pytest

from evenbreak.handicaps import (
    Averages,
    NapaLike,
    apa_like,
    pasco_race,
    system_of,
    tap_like,
)
from evenbreak.handicaps.charts.chart_of import chart_of
from evenbreak.handicaps.systems.history import Entries, History, Matches
from evenbreak.handicaps.systems.level_review import LevelReview, applied_score, level_of_innings


@pytest.mark.parametrize(
    ("ratings", "race"),
    [
        ((20, 20), (2, 2)),
        ((47, 30), (3, 2)),
        ((94, 74), (6, 4)),
        ((107, 65), (7, 3)),
        ((97, 12), (10, 2)),
        ((106, 38), (8, 2)),
        # A point at the edge of a band lengthens the race.
        ((69, 60), (4, 3)),
        ((70, 61), (5, 4)),
        ((39, 39), (2, 2)),
        ((40, 40), (3, 3)),
    ],
)
def test_races_of_the_napa_calculator(ratings, race):
    assert tuple(map(int, NapaLike().race(*ratings))) == race


def test_the_upper_bands_of_napa_begin_as_the_charts_of_the_national_pool_league():
    napa = NapaLike()
    for chart, stronger, up_to in (("npl_8", 69, 48), ("npl_10", 89, 56), ("npl_12", 140, 58)):
        for apart in range(up_to):
            by_chart = system_of("npl").on_chart(chart_of(chart))
            assert by_chart.race(stronger, stronger - apart) == napa.race(
                stronger, stronger - apart
            )


def test_tucson_gives_nine_a_round_to_sums_of_40_and_35():
    assert Averages(correction=1.8).head_start(40.0, 35.0) == pytest.approx(9.0)


def test_a_head_start_is_worth_the_race_by_the_points_of_each_score():
    """Over nine games, 10 a game won and 4 a game lost, the points decide as the race does."""
    system = Averages(balls=4.0, correction=2.0)
    for better in np.arange(5.0, 9.0, 0.25):
        m, n = system.race(better, 6.0)
        head_start = 9 * 2.0 * (better - 6.0)
        for won in range(10):
            ahead = (10 - 4) * (won - (9 - won)) - head_start
            if ahead != 0.0:
                assert (won >= m) == (ahead > 0.0) == (9 - won < n)


def test_pasco_s_chart():
    rows = [(0, 14, 13), (15, 40, 14), (41, 66, 15), (67, 92, 16), (93, 118, 17), (119, 144, 18)]
    for first, last, games in [*rows, (145, 400, 19)]:
        for difference in (first, last):
            m, n = pasco_race(difference)
            assert (m, n) == (games, 26 - games)


@pytest.mark.parametrize(
    ("many", "best"),
    [(1, 1), (2, 2), (3, 2), (4, 2), (5, 3), (6, 3), (7, 4), (9, 5), (12, 6), (19, 10), (20, 10)],
)
def test_the_innings_window_keeps_the_scores_of_the_table_of_2006(many, best):
    scores = np.full((20, 1), np.nan)
    scores[:many, 0] = np.arange(many, 0, -1)
    mean = apa_like()._mean(scores, np.array([many]))
    assert mean[0] == pytest.approx(np.arange(1, best + 1).mean())


def test_the_levels_and_applied_scores_of_2006():
    assert level_of_innings([2.0, 2.01, 4.0, 5.0, 7.0, 7.01]).tolist() == [7, 6, 5, 4, 3, 2]
    shares = np.array([1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1])
    of_seven = [1.1, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9]
    for level in (7, 6, 5, 4, 3):
        expected = np.array(of_seven) + 7 - level
        np.testing.assert_allclose(applied_score(level, shares), expected)
    assert (applied_score(2, shares) == 7.0).all()


def test_the_tap_window_averages_19_of_21():
    scores = np.arange(21.0)[:, None]
    scores[0], scores[1] = 100.0, -100.0
    assert tap_like()._mean(scores, np.array([21]))[0] == pytest.approx(np.arange(2, 21).mean())


def test_nobody_falls_below_the_peak_less_two_or_moves_more_than_a_level_a_night():
    """A level 6 who loses every game falls to 4, one level a night, and stays there."""
    system = LevelReview()
    entries = Entries.of(level=[6.0, 4.0], matches=[3, 20])
    initial = ratings = system.initial(entries)
    seen, nights = [], []
    for night in range(1, 7):
        m, n = system.race(ratings[:1], ratings[1:])
        nights.append((night, 0, 1, 0, int(n[0]), int(m[0]), int(n[0]), *ratings.tolist()))
        matches = Matches(*map(np.array, zip(*nights, strict=True)))
        ratings = system.update(History(entries, initial, ratings, night, matches))
        seen.append(ratings[0])
    assert seen == [5.0, 4.0, 4.0, 4.0, 4.0, 4.0]
