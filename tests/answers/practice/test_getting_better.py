import numpy as np
import pytest

from evenbreak.answers.practice.practice import getting_better_answer, interval_of
from evenbreak.files.practice import ScoresFile
from evenbreak.stats import mean_interval, trend

WEEKS = np.arange("2024-09-02", "2024-11-11", 7, dtype="M8[D]")
STEADY = np.array([50.0, 44, 46, 52, 47, 51, 49, 45, 48, 50])


def file_of(scores, dates=WEEKS):
    return ScoresFile(np.asarray(scores, float), dates, "s.csv", ())


def first(scores, dates=WEEKS):
    return getting_better_answer(file_of(scores, dates)).sentences[0]


def test_json_has_the_interval_and_the_trend():
    found = getting_better_answer(file_of(STEADY), confidence=0.8).to_dict()
    own, line = mean_interval(STEADY, 0.8), trend(range(10), STEADY, 0.8)
    assert (found["n"], found["mean"], found["sd"]) == (10, own.mean, own.sd)
    assert (found["low"], found["high"]) == (own.low, own.high)
    assert found["slope_per_week"] == pytest.approx(line.slope)
    assert found["p_slope"] == pytest.approx(line.p_value)


def test_a_slope_that_luck_explains_is_no_change():
    assert first(STEADY).startswith("No sign of a change")


@pytest.mark.parametrize(("sign", "word"), [(1, "gain"), (-1, "lose")])
def test_a_clear_slope_has_a_direction(sign, word):
    rising = 50 + sign * np.arange(10) + np.array([0, 1] * 5)
    sentence = first(rising)
    assert sentence.startswith(f"You {word} ")
    assert "not luck" in sentence


def test_the_average_is_not_taken_for_steady_while_scores_drift():
    rising = getting_better_answer(file_of(np.arange(10.0) + [0, 1] * 5))
    assert "steady" in rising.sentences[1]
    assert "steady" not in getting_better_answer(file_of(STEADY)).sentences[1]


def test_statistics_are_in_the_details():
    answer = getting_better_answer(file_of(STEADY))
    assert "Student" not in " ".join(answer.sentences)
    assert "Student" in " ".join(map(str, answer.details))


@pytest.mark.parametrize(
    ("scores", "dates"),
    [([48], WEEKS[:1]), ([48, 48], WEEKS[:2]), (STEADY, None), ([4, 5], WEEKS[:2])],
    ids=["one score", "equal scores", "no dates", "two scores"],
)
def test_scores_that_show_no_trend_say_why(scores, dates):
    answer = getting_better_answer(file_of(scores, dates))
    assert answer.to_dict()["slope_per_week"] is None
    assert "getting better" in answer.sentences[0]


def test_equal_scores_have_no_interval():
    assert interval_of(file_of([48, 48], None), 0.95) is None
    assert interval_of(file_of([48], None), 0.95) is None
    assert interval_of(file_of(STEADY), 0.8) == mean_interval(STEADY, 0.8)
