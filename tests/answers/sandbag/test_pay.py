"""What sandbagging pays, in words and numbers."""

import pytest

from evenbreak.answers.sandbag.pay import (
    PayQuestion,
    sandbag_charts_answer,
    sandbag_pay,
    sandbag_pay_answer,
)
from evenbreak.errors import InputError
from evenbreak.handicaps import Ladder, chart

QUESTION = PayQuestion(3, 20, 0, 10.0, 1.0, 3, 0.0)


@pytest.fixture(scope="module")
def found():
    return sandbag_pay(Ladder("npl", widest=120), QUESTION)


def test_the_sentences_have_the_numbers_of_the_json(found):
    answer = sandbag_pay_answer(found, QUESTION)
    data, text = answer.to_dict(), " ".join(answer.sentences)
    assert f"dump {data['best']['dumped']} matches," in text
    assert f"a profit of {data['best']['profit']:.2f}" in text
    assert f"dump {data['cycle']['dumped']} and play {data['cycle']['earnest']}" in text
    assert f"{data['enters_low']['established']:.2f} more" in text


def test_the_best_number_may_lie_beyond_the_table(found):
    assert found.all_pays.best.dumped > len(found.pays.rows)
    assert len(sandbag_pay_answer(found, QUESTION).to_frame()) == 4


def test_stakes_at_which_nothing_pays():
    question = QUESTION._replace(stake=0.0)
    answer = sandbag_pay_answer(sandbag_pay(Ladder("npl", widest=60), question), question)
    assert "does not pay" in answer.sentences[0]


def test_charts_are_named_by_what_they_invite(found):
    long = sandbag_pay(Ladder("npl", chart("npl_20"), widest=120), QUESTION, cycles=False)
    answer = sandbag_charts_answer([long, found], QUESTION)
    assert answer.sentences[0].startswith("Sandbagging pays least on npl_10")
    assert list(answer.to_frame()["chart"]) == ["npl_20", "npl_10"]


def test_a_ladder_without_room_is_refused():
    with pytest.raises(InputError, match="step 200"):
        sandbag_pay(Ladder("step 200", widest=120), QUESTION)
