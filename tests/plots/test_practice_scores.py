import numpy as np
import pytest
from scipy.stats import linregress, t

from evenbreak.answers.practice.practice import getting_better_answer, trend_line_of
from evenbreak.files.practice import ScoresFile
from evenbreak.plots.practice import draw_scores, draw_two_lists
from evenbreak.stats import mean_interval

SCORES = np.array([50.0, 44.0, 46.0, 52.0])
DAYS = np.array(["2024-09-03", "2024-09-10", "2024-09-17", "2024-09-24"], "M8[D]")


@pytest.mark.parametrize("days", [None, DAYS])
def test_scores_mean_band_and_the_new_one_after_them(days):
    interval = mean_interval(SCORES, 0.8)
    axes = draw_scores(ScoresFile(SCORES, days, "s.csv", ()), interval, new=53)
    assert axes.get_title() == "Practice scores of s.csv"
    points, mean, new = axes.lines
    assert points.get_ydata().tolist() == SCORES.tolist()
    assert set(mean.get_ydata()) == {48.0}
    assert new.get_ydata() == [53]
    assert new.get_xdata()[0] == (5.0 if days is None else np.datetime64("2024-10-01"))
    (band,) = axes.patches
    assert (band.get_y(), band.get_y() + band.get_height()) == pytest.approx(interval[:2])
    assert [text.get_text() for text in axes.figure.legends[0].get_texts()] == [
        "80% interval of the true mean",
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
    assert axes.get_title() == "Practice scores, and their mean with its 95% interval"


def test_lists_without_intervals():
    axes = draw_two_lists(SCORES[:1], SCORES[1:2], ("old", "new"), (None, None))
    assert axes.get_title() == "Practice scores, and their mean"
    assert [text.get_text() for text in axes.texts] == ["50.00", "44.00"]
