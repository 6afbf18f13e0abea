from dataclasses import replace

import numpy as np
import pytest
from matplotlib.patches import Rectangle
from scipy.stats import linregress, t

from evenbreak.answers.practice.practice import getting_better_answer, trend_line_of
from evenbreak.files.practice import ScoresFile, read_practice
from evenbreak.games import Drill
from evenbreak.matches import StraightPool, even_spot, straight_pool_odds
from evenbreak.plots.practice import (
    draw_drill,
    draw_log,
    draw_practice_shots,
    draw_score,
    draw_scores,
    draw_spot,
    draw_two_lists,
)
from evenbreak.practice import DrillLog, analyze_log, analyze_shots, drill_statistics
from evenbreak.stats import InningsScore, RunLength, mean_interval
from places import DATA

SCORES = np.array([50.0, 44.0, 46.0, 52.0])
DAYS = np.array(["2024-09-03", "2024-09-10", "2024-09-17", "2024-09-24"], "M8[D]")


@pytest.mark.parametrize("days", [None, DAYS])
def test_scores_mean_band_and_the_new_one_after_them(days):
    interval = mean_interval(SCORES, 0.8)
    axes = draw_scores(ScoresFile(SCORES, days, "s.csv", ()), interval, new=53)
    assert axes.get_title() == "Practice scores: s.csv"
    points, mean, new = axes.lines
    assert points.get_ydata().tolist() == SCORES.tolist()
    assert set(mean.get_ydata()) == {48.0}
    assert new.get_ydata() == [53]
    assert new.get_xdata()[0] == (5.0 if days is None else np.datetime64("2024-10-01"))
    (band,) = axes.patches
    assert (band.get_y(), band.get_y() + band.get_height()) == pytest.approx(interval[:2])
    assert [text.get_text() for text in axes.figure.legends[0].get_texts()] == [
        "80% interval for the true mean",
        "scores",
        "mean 48.00",
        "new score 53",
    ]


def test_the_trend_that_the_text_states_is_drawn_with_its_band():
    dates = DAYS[[2, 0, 3, 1]]
    file = ScoresFile(SCORES, dates, "s.csv", ())
    said = getting_better_answer(file, confidence=0.8).sentences[0]
    axes = draw_scores(file, mean_interval(SCORES, 0.8), trend_line_of(file, 0.8))
    trend = axes.lines[-1]
    assert trend.get_label() == "trend"
    weeks = (trend.get_xdata() - DAYS[0]).astype(float) / 7.0
    slope, _ = np.polyfit(weeks, trend.get_ydata(), 1)
    assert f"{abs(slope):.2f} points a week" in said
    # The band is that of the textbook's formula.
    scores = SCORES[np.argsort(dates)]
    fit = linregress(weeks, scores)
    line = fit.intercept + fit.slope * weeks
    spread, away = np.sqrt(((scores - line) ** 2).sum() / 2.0), (weeks - weeks.mean()) ** 2
    half = t.ppf(0.9, 2) * spread * np.sqrt(0.25 + away / away.sum())
    (band,) = axes.collections
    edge = band.get_paths()[0].vertices[:, 1]
    assert (edge.min(), edge.max()) == pytest.approx(((line - half).min(), (line + half).max()))


def test_equal_scores_stand_beside_one_another():
    many = np.full(100, 7.0)
    axes = draw_two_lists(SCORES, many, ("old", "new"), (mean_interval(SCORES), None))
    strip = axes.lines[-2]
    across = strip.get_xdata()
    assert len(set(np.round(across, 6))) == 100
    assert 0.69 < min(across) < max(across) < 1.31
    assert axes.get_title() == "Practice scores, with their means and 95% intervals"


def test_lists_without_intervals():
    axes = draw_two_lists(SCORES[:1], SCORES[1:2], ("old", "new"), (None, None))
    assert axes.get_title() == "Practice scores, with their means"
    assert [text.get_text() for text in axes.texts] == ["50.00", "44.00"]


@pytest.mark.parametrize(
    "law", [RunLength(0.96), InningsScore(0.96, 5), InningsScore(0.96, 5, 0.5), RunLength(0)]
)
def test_mean_median_and_mode_stand_where_they_are(law):
    axes = draw_score(law)
    marks = [line for line in axes.lines if line.get_label()[0] != "_"]
    assert [line.get_xdata()[0] for line in marks] == list(law.fair_line)
    assert [line.get_label().split()[0] for line in marks] == ["mean", "median", "mode"]
    assert len({line.get_color() for line in marks}) == 3


def test_scores_are_drawn_with_their_probabilities():
    law = InningsScore(0.9, 3)
    axes = draw_score(law, 3)
    curve = axes.lines[0]
    assert curve.get_ydata().tolist() == law.probability(curve.get_xdata()).tolist()
    assert law.between(curve.get_xdata()[0], curve.get_xdata()[-1]) > 0.99
    assert axes.get_xlabel() == "balls made in 3 innings"


def test_what_was_asked_is_shaded_and_named():
    law = RunLength(0.96)
    asked = [("20 to 20", 20, 20), ("over 30", 31, None), ("far", 5000, None)]
    axes = draw_score(law, asked=asked)
    _, *shades = axes.collections
    assert [shade.get_label() for shade in shades] == [
        f"20 to 20: {100 * law.probability(20):.1f}%",
        f"over 30: {100 * law.at_least(31):.1f}%",
        "far: 0.0%",
    ]
    assert len({shade.get_hatch() for shade in shades}) == 3
    one, above, far = (shade.get_paths() for shade in shades)
    assert (one[0].get_extents().x0, one[0].get_extents().x1) == (19.5, 20.5)
    assert above[0].get_extents().x0 == 30.5
    assert not far


def test_no_line_where_no_spot_is_even():
    axes = draw_spot(StraightPool(9, 9, 0, 0.8))
    labels = [text.get_text() for text in axes.get_legend().get_texts()]
    assert labels == ["9 points to 9"]


@pytest.mark.parametrize(("p1", "p2"), [(0.9, 0.8), (0.8, 0.9)])
def test_the_curve_is_the_chance_by_the_points_of_the_weaker_player(p1, p2):
    match = StraightPool(100, 80, p1, p2, first=2)
    spot = even_spot(match)
    axes = draw_spot(match)
    curve, dot, *_, mark = axes.lines
    for n, win in zip(curve.get_xdata()[::30], curve.get_ydata()[::30], strict=True):
        needs = (int(n), 80) if spot.weaker == 1 else (100, int(n))
        assert win == straight_pool_odds(StraightPool(*needs, p1, p2, first=2)).p_win_1
    assert dot.get_xdata()[0] == (100 if spot.weaker == 1 else 80)
    assert dot.get_ydata()[0] == straight_pool_odds(match).p_win_1
    assert mark.get_xdata()[0] == spot.points


def heights(axes):
    bars = (patch for patch in axes.patches if isinstance(patch, Rectangle))
    return [bar.get_height() for bar in bars]


def test_a_bar_for_each_level():
    statistics = drill_statistics(Drill.progressive(0.8))
    axes = draw_drill(statistics)
    assert heights(axes) == pytest.approx(statistics.distribution.probability)
    assert axes.get_legend().get_texts()[0].get_text() == "mean 4.35"


def test_a_pair_of_bars_for_each_level_told_apart_without_color():
    log = DrillLog([1, 2, 3, 2, 1, 1], [1, 1, 0, 0, 0, 1])
    analysis = analyze_log(log, rng=np.random.default_rng(1), replicas=9)
    axes = draw_log(analysis)
    assert heights(axes) == pytest.approx([3 / 6, 2 / 6, 1 / 6, *analysis.implied.probability])
    ends = next(line for line in axes.lines if "interval" in str(line.get_label()))
    assert ends.get_xdata() == pytest.approx([analysis.mean_low, analysis.mean_high])
    bars = axes.patches
    assert {bar.get_hatch() for bar in bars[:3]} != {bar.get_hatch() for bar in bars[3:]}


def test_many_levels_have_no_crowd_of_ticks():
    axes = draw_drill(drill_statistics(Drill.progressive(0.9, 60)))
    assert len(axes.get_xticks()) < 20


def test_a_log_of_shots_is_drawn_with_the_halves_that_its_text_states():
    file = read_practice(DATA / "practice_shots.csv")
    found = analyze_shots(file.log)
    axes = draw_practice_shots(file, found)
    texts = [text.get_text() for text in axes.figure.legends[0].get_texts()]
    assert texts[-2:] == ["before 2024-10-01: 50%", "since 2024-10-01: 62%"]
    halves = {float(line.get_ydata()[0]) for line in axes.lines if len(line.get_ydata()) == 2}
    assert halves == {found.change.before, found.change.after}
    undated = file._replace(log=replace(file.log, day=None))
    axes = draw_practice_shots(undated, analyze_shots(undated.log))
    assert len(axes.get_xticklabels()) == 5
