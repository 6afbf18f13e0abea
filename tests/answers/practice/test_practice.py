import numpy as np
import pytest

from evenbreak.answers.practice.practice import before_and_after_answer
from evenbreak.files.practice import ScoresFile
from evenbreak.stats import compare

BEFORE = np.array([50.0, 44, 46, 52, 47, 51, 49, 45, 48, 50])
AFTER = np.array([53.0, 49, 52, 54, 50, 51])


def answer_of(before, after):
    files = [ScoresFile(np.asarray(one, float), None, "s.csv", ()) for one in (before, after)]
    return before_and_after_answer(*files, compare(before, after))


def test_json_has_every_test():
    found, answer = compare(BEFORE, AFTER), answer_of(BEFORE, AFTER).to_dict()
    assert (answer["difference"], answer["low"], answer["high"]) == (
        *(found.difference, found.low, found.high),
    )
    for name in ("welch", "student", "anova", "variances", "mann_whitney", "chi_squared"):
        assert answer[f"p_{name}"] == getattr(found, name).p_value
    assert (answer["g"], answer["g_low"], answer["g_high"], answer["p_after_higher"]) == (
        found.effect
    )
    assert (answer["n_before"], answer["mean_after"], answer["sd_after"]) == (
        *(10, found.after.mean, found.after.sd),
    )


@pytest.mark.parametrize(
    ("shift", "words"),
    [
        (0.0, ("No sign of a change", "the same as before", "nearly always")),
        (-1.5, ("No sign of a change", "1.50 points less", "about 13 times in 100")),
        (-1.7, ("1.70 points less", "could be luck", "1 time in 11")),
        (2.0, ("2.00 points more", "probably not luck", "1 time in 20")),
        (9.0, ("9.00 points more", "this is not luck", "less than 1 time in 1000")),
    ],
)
def test_the_verdict_follows_the_chance(shift, words):
    before = np.arange(10.0) * 0.7
    sentence = answer_of(before, before + shift).sentences[0]
    for word in words:
        assert word in sentence


def test_statistics_are_in_the_details():
    answer = answer_of(BEFORE, AFTER)
    assert "Welch" not in " ".join(answer.sentences)
    assert "Welch" in answer.details[0]


def test_what_makes_a_test_rough_is_said_beside_it():
    rough = " ".join(answer_of(BEFORE, AFTER).details)
    assert "Mann-Whitney" in rough
    assert "Chi-squared" in rough
    many = answer_of(np.arange(0.0, 40.0), np.arange(0.5, 40.5))
    assert len(many.details) == 1
    assert list(many.warnings) == []


def test_few_scores_are_warned_of():
    (warning,) = answer_of(BEFORE, AFTER).warnings
    assert "6 scores" in warning


def test_lists_without_spread():
    same, moved = answer_of([5, 5], [5, 5, 5]), answer_of([0.1] * 3, [0.2] * 4)
    assert "nothing has changed" in same.sentences[0]
    assert "0.10 points more" in moved.sentences[0]
    assert "luck" in moved.sentences[0]
    assert len(moved.sentences) == 1


def test_one_list_without_spread_has_no_verdict_and_a_warning():
    answer = answer_of([0.1, 0.1, 0.1], [11.0, 12.0, 13.0])
    assert answer.to_dict()["p_welch"] < 0.05
    assert "equal scores" in answer.sentences[0]
    assert any("all scores before are 0.1" in warning for warning in answer.warnings)
