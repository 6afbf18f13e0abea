from fractions import Fraction

import pytest

from evenbreak.answers.practice.runs import Asked, runs_answer
from evenbreak.stats import InningsScore, RunLength

LAW = RunLength(0.96)


def first(law, **asked):
    return runs_answer(law, Asked(**asked)).sentences[0]


def test_json_has_the_law_and_what_was_asked():
    found = runs_answer(LAW, Asked(100, (50, 75), 20.5)).to_dict()
    assert (found["mean"], found["median"], found["mode"], found["sd"]) == (24, 16, 0, LAW.sd)
    assert found["p_at_least"] == LAW.at_least(100)
    assert found["p_between"] == LAW.between(50, 75)
    assert (found["p_over"], found["p_not_over"]) == (LAW.at_least(21), LAW.cumulative(20))


def test_what_was_not_asked_is_missing():
    found = runs_answer(LAW, Asked()).to_dict()
    assert [found[key] for key in ("p_at_least", "p_between", "p_over", "p_not_over")] == [None] * 4


def test_a_line_between_two_scores_is_passed_by_the_next_one():
    assert Asked(over=20.5).losing == Asked(over=20).losing == 20
    assert Asked(over=20.5).ranges["p_over"][1:] == (21, None)


def test_the_answer_to_the_question_comes_first():
    assert "1.7%" in first(LAW, at_least=100)
    assert "59 innings" in first(LAW, at_least=100)
    assert "42%" in first(LAW, over=20)


@pytest.mark.parametrize(("line", "side"), [(20, "a bad bet"), (10, "a good bet")])
def test_a_bet_at_even_money_has_a_side(line, side):
    assert side in first(LAW, over=line)


def test_a_bet_on_the_median_is_fair():
    assert "a fair bet" in first(InningsScore(0.5, 8), over=7)
    assert "a fair bet" in first(LAW, over=LAW.median)


def test_the_rule_of_thumb_is_left_out_where_it_does_not_hold():
    several = runs_answer(InningsScore(Fraction(24, 25), 3, 0.8), Asked()).to_dict()
    assert several["median_estimate"] is None
    assert runs_answer(RunLength(0.96, 0.8), Asked()).to_dict()["median_estimate"] is not None


def test_a_median_of_no_ball():
    assert "are 0" in first(RunLength(0))


@pytest.mark.parametrize(
    ("p_make", "n", "words"),
    [
        (0.5, 10, "once in 1,024 innings."),
        (1e-70, 2, "once in 1e+140 innings."),
        (1e-160, 2, "less than 0.1% of the time."),  # 1 / 1e-320 is larger than any float
    ],
)
def test_how_rare_a_run_is_stays_readable(p_make, n, words):
    assert words in first(RunLength(p_make), at_least=n)
