import numpy as np
import pytest

from evenbreak.answers.practice.practice import new_score_answer
from evenbreak.files.practice import ScoresFile
from evenbreak.stats import was_it_luck

EARLIER = ScoresFile(
    np.array([50.0, 44, 46, 52, 47, 51, 49, 45, 48, 50]), None, "s.csv", ("look here",)
)


def test_json_has_all_three_readings():
    luck = was_it_luck(EARLIER.scores, 53, confidence=0.8)
    found = new_score_answer(EARLIER, 53, confidence=0.8).to_dict()
    assert (found["units"], found["p_as_far"], found["p_as_high"], found["p_as_low"]) == luck.t
    assert (found["units_normal"], found["p_as_far_normal"]) == luck.normal[:2]
    assert (found["units_cautious"], found["p_as_far_cautious"]) == luck.cautious[:2]
    assert found["p_as_high_by_rank"] == luck.as_high_by_rank


@pytest.mark.parametrize(
    ("score", "verdict"),
    [(53, "may well be luck"), (54, "could be luck"), (56, "probably not luck"), (60, "not luck")],
)
def test_the_verdict_follows_the_chance(score, verdict):
    sentence = new_score_answer(EARLIER, score).sentences[0]
    assert f"this {'is ' if 'not' in verdict else ''}{verdict}" in sentence
    assert "above" in sentence


def test_only_the_side_of_the_score_is_shown():
    for score, high in ((53, True), (40, False)):
        (quantities,) = [
            part for part in new_score_answer(EARLIER, score).parts if not isinstance(part, str)
        ]
        shown = {one.name for one in quantities.shown(verbose=True)}
        assert ("p_as_high" in shown) is high
        assert ("p_as_low" in shown) is not high


def test_a_score_on_the_mean_is_nothing_new():
    answer = new_score_answer(EARLIER, 48.2)
    assert answer.to_dict()["units"] == 0.0
    assert "nothing new" in answer.sentences[0]


def test_warnings_of_the_file_are_handed_on():
    assert tuple(new_score_answer(EARLIER, 53).warnings) == ("look here",)
