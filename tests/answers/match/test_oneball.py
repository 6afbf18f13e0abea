import pytest

from evenbreak.answers.match.shot_games import oneball_answer
from evenbreak.practice import ShotChoice


def advice(*shots, look_ahead="infinite"):
    named = [ShotChoice(str(number), *chances) for number, chances in enumerate(shots, start=1)]
    return oneball_answer(named, look_ahead=look_ahead).sentences[0]


def test_the_best_shot_comes_first_with_what_it_wins():
    words = advice((0.4, 0.8), (0.3, 0.3))
    assert words.startswith("Take shot 2")
    for number in ("59%", "45%", "51%"):  # 10/17, 5/11, and where shot 1 is as good
        assert number in words


def test_the_other_look_ahead_is_named_where_it_prefers_another_shot():
    assert advice((0.1, 0.05), (0.5, 0.8)).split("\n")[-1].endswith("shot 2 is better.")
    two_shots = advice((0.1, 0.05), (0.5, 0.8), look_ahead="two shots")
    assert two_shots.split("\n")[-1].endswith("shot 1 is better.")
    assert "better" not in advice((0.4, 0.8), (0.3, 0.3))


@pytest.mark.parametrize(
    ("shot", "words"),
    [
        ((0.4, 0.8), "would be the favorite if a miss left a chance below 0.6667"),
        ((0.4, 0.2), "are the favorite as long as a miss leaves a chance below 0.6667"),
        ((0.6, 1), "are the favorite, whatever"),
        ((0.5, 1), "even"),
        ((0, 0), "no one wins"),
        ((0, 0.5), "not the favorite"),
    ],
)
def test_a_shot_alone(shot, words):
    assert words in advice(shot)


def test_equally_good_shots():
    assert advice((0.5, 0.5), (0.4, 1 / 3), (0.5, 0.5)).startswith("Shots 1, 2 and 3 are equally")
    assert advice((0.5, 0.5), (0.2, 0.2), (0.5, 0.5)).startswith("Shots 1 and 3 are equally")


def test_a_shot_that_is_the_best_whatever_it_leaves():
    words = advice((0.9, 1), (0.2, 0.2))
    assert words.startswith("Take shot 1")
    assert "whatever" in words
