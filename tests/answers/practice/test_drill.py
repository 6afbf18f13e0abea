import pytest

from evenbreak.answers.practice.drill import drill_answer
from evenbreak.games import Drill
from evenbreak.practice import drill_statistics


def answer_of(*success):
    return drill_answer(drill_statistics(Drill(success)), "a drill")


def test_the_advice_comes_first():
    statistics = drill_statistics(Drill.progressive(0.8))
    first = drill_answer(statistics, "a drill").sentences[0]
    assert f"level {statistics.practice_next}" in first
    assert f"{statistics.lift[statistics.practice_next - 1]:.2f}" in first
    assert f"{statistics.distribution.mean:.2f}" in first


def test_a_level_hardly_missed_has_no_room_for_five_more():
    assert "five more" not in answer_of(0.99, 0.98, 0.97).sentences[0]
    assert "five more" in answer_of(0.99, 0.98, 0.95).sentences[0]


def test_where_nothing_lifts_no_level_is_advised():
    answer = answer_of(1.0, 1.0)
    assert answer.to_dict()["practice_next"] is None
    assert "level 1" not in answer.sentences[0]


def test_json_has_the_levels_and_the_law():
    statistics = drill_statistics(Drill([0.5, 0.0, 1.0]))
    found = drill_answer(statistics, "a drill").to_dict()
    assert [row["p_success"] for row in found["drill_levels"]] == [0.5, 0.0, 1.0]
    assert found["drill_levels"][1]["gain"] is None  # the mean jumps there
    law = statistics.distribution
    assert (found["mean"], found["median"], found["mode"], found["sd"]) == pytest.approx(
        (law.mean, law.median, law.mode, law.sd)
    )


def test_to_and_fro_has_a_sentence_of_its_own():
    assert len(answer_of(1.0, 0.0).sentences) == len(answer_of(0.9, 0.0).sentences) + 1
