import pytest

from evenbreak.answers.match.formats import Compared, compare_answer
from evenbreak.answers.match.odds import TwoPlayers
from evenbreak.games import Rack
from evenbreak.matches import crossings, even_probability, match_format, match_odds

RACK = Rack(0.6)


def answer_of(*texts):
    formats = [match_format(text) for text in texts]
    compared = [
        Compared(played, match_odds(played.match(RACK)), even_probability(played))
        for played in formats
    ]
    pairs = {
        (i, j): crossings(formats[i], formats[j])
        for i in range(len(formats))
        for j in range(i + 1, len(formats))
    }
    return compare_answer(TwoPlayers(RACK), compared, pairs)


def test_the_advice_names_the_best_for_each_and_the_fairest():
    best_for_a, fairest = answer_of("1:1", "3:3").sentences[0].split("\n")
    assert best_for_a.index("A does best with 3:3") < best_for_a.index("B does best with 1:1")
    assert fairest == "Closest to even: 1:1."


def test_formats_that_are_the_same_are_said_to_be():
    answer = answer_of("1:1", "ahead 1:1")
    assert "worth the same" in answer.sentences[0]
    assert answer.parts[-1].rows == [("1:1 or ahead 1:1", "always worth the same")]


def test_one_format_alone_is_not_compared():
    answer = answer_of("3:3")
    assert answer.to_dict()["crossings"] == []
    assert "68%" in answer.sentences[0]


@pytest.mark.parametrize(
    ("one", "two", "words"),
    [
        ("2:1", "4:2", "2:1 up to 0.6404, then 4:2"),
        ("4:2", "2:1", "2:1 up to 0.6404, then 4:2"),
        ("3:3", "3:2", "always 3:3"),
        ("ahead 6:1", "6:2", "6:2 up to 0.3106, ahead 6:1 up to 0.9372, then 6:2"),
    ],
)
def test_which_is_better_where(one, two, words):
    assert answer_of(one, two).parts[-1].rows == [(f"{one} or {two}", words)]
