import numpy as np
import pytest

from evenbreak.stats.compare import compare
from evenbreak.stats.compare_sentence import how_often

BEFORE = [50, 44, 46, 52, 47, 51, 49, 45, 48, 50]
AFTER = [53, 49, 52, 54, 50, 51]


def test_warnings_come_where_they_are_due():
    text = "\n".join(compare(BEFORE, AFTER).warnings)
    assert "only 6 scores" in text
    assert "Mann-Whitney" in text
    assert "chi-squared" in text
    many = compare(np.arange(0.0, 40.0), np.arange(0.5, 40.5))
    assert many.warnings == ()


@pytest.mark.parametrize(
    ("shift", "words"),
    [
        (0.0, ("The mean is the same after as before", "no evidence", "come nearly always")),
        (-1.5, ("The mean is 1.50 lower after", "no evidence", "about 13 times in 100")),
        (-1.7, ("The mean is 1.70 lower after", "a hint of a change", "1 time in 11")),
        (2.0, ("The mean is 2.00 higher after", "this is evidence of a change", "1 time in 20")),
        (9.0, ("9.00 higher", "strong evidence of a change", "less than 1 time in 1000")),
    ],
)
def test_sentence(shift, words):
    before = np.arange(10.0) * 0.7
    sentence = compare(before, before + shift).sentence
    for word in (*words, "95 % interval", "Welch's t test"):
        assert word in sentence


def test_lists_without_spread():
    same, moved = compare([5, 5], [5, 5, 5]), compare([0.1] * 3, [0.2] * 4)
    assert same.sentence == "All scores, before and after, are 5: nothing has changed."
    assert moved.sentence == (
        "The mean is 0.10 higher after: all scores before are 0.1, all after 0.2. "
        "No test of the means can be made without a spread."
    )
    assert ["only 2 scores" in line for line in same.warnings] == [True]
    assert not any("spread" in line for line in moved.warnings)


def test_one_list_without_spread_is_warned_of():
    found = compare([0.1, 0.1, 0.1], [11.0, 12.0, 13.0])
    assert found.welch is not None
    assert found.welch.p_value < 0.05
    assert any(
        line.startswith("all scores before are 0.1: their spread is not known")
        for line in found.warnings
    )
    assert "hard to tell, since one list has equal scores only" in found.sentence
    assert "or more often" in found.sentence
    assert "evidence" not in found.sentence


@pytest.mark.parametrize(
    ("p", "words"),
    [
        (1e-9, "less than 1 time in 1000"),
        (0.001, "about 1 time in 1000"),
        (0.05, "about 1 time in 20"),
        (0.1, "about 10 times in 100"),
        (0.5, "about 50 times in 100"),
        (0.999, "nearly always"),
    ],
)
def test_how_often(p, words):
    assert how_often(p) == words
