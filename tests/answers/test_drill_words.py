from dataclasses import replace

import numpy as np
import pytest

from evenbreak.answers.drill_words import SPACE, drill_advice, log_advice
from evenbreak.games import Drill
from evenbreak.practice import (
    DrillLog,
    LogAnalysis,
    PlayedAgainTest,
    analyse_log,
    drill_statistics,
)


@pytest.fixture(scope="module")
def analysis() -> LogAnalysis:
    log = DrillLog([1, 2, 3, 2, 3, 2, 1, 1, 2], [1, 1, 0, 1, 0, 0, 0, 1, 1])
    return analyse_log(log, rng=np.random.default_rng(1), replicas=99)


def told(analysis: LogAnalysis, **changes: object) -> str:
    return " ".join(log_advice(replace(analysis, **changes))).replace(SPACE, " ")  # type: ignore[arg-type]


def test_what_is_odd_is_told_as_odd(analysis: LogAnalysis) -> None:
    odd = PlayedAgainTest(0.25, 0.05, 0.001)
    assert "That is more than chance explains (p = 0.001)" in told(analysis, difference=odd)
    assert "Perhaps you stop when it goes well." in told(analysis, difference=odd)
    assert "a miss seems to weigh on the next attempt" in told(analysis, memory=odd)
    assert "differ from that more than chance explains" in told(analysis, model_test=odd)


def test_what_is_not_odd_is_told_as_such(analysis: LogAnalysis) -> None:
    plain = PlayedAgainTest(0.25, 0.2, 0.4)
    assert "Nothing odd (p = 0.4)" in told(analysis, difference=plain)
    assert "Perhaps" not in told(analysis, difference=plain)
    assert "25 times in 100 more often after a success than after a miss" in told(
        analysis, memory=plain
    )
    assert "No sign of it (p = 0.4)" in told(analysis, memory=plain)
    assert "No level stands out from that (p = 0.4)" in told(analysis, model_test=plain)


def test_a_memory_the_other_way_round(analysis: LogAnalysis) -> None:
    words = told(analysis, memory=PlayedAgainTest(-0.25, -0.02, 0.001))
    assert "25 times in 100 less often" in words
    assert "by chance alone it would be 2 times in 100 less often." in words
    assert "a success seems to make the next attempt worse" in words


def test_no_difference_is_told_as_none(analysis: LogAnalysis) -> None:
    words = told(analysis, memory=PlayedAgainTest(0.004, -0.004, 0.9))
    assert "as often after a success as after a miss; by chance alone it would be as often" in words


def test_misses_at_level_1_are_told(analysis: LogAnalysis) -> None:
    assert "its 3 attempts, 1 missed, are left out of it" in told(analysis)


def test_who_is_sure_names_one_level(analysis: LogAnalysis) -> None:
    def advice(share: float) -> str:
        first, second, third = analysis.levels
        levels = (
            first._replace(p_best=0.0),
            second._replace(p_best=share),
            third._replace(p_best=1 - share),
        )
        return told(analysis, levels=levels)

    assert "It is 90 % sure that no other level helps more." in advice(0.9)
    assert "It is 60 % sure that no other level helps more, and 40 % for level 3" in advice(0.6)


def test_a_level_hardly_missed_has_no_room_for_five_more() -> None:
    words = drill_advice(drill_statistics(Drill([0.99, 0.98, 0.97])))
    assert "at level 3: successes without a miss there lift the mean level by 0.03" in words
    assert "five more" in drill_advice(drill_statistics(Drill([0.99, 0.98, 0.95])))


@pytest.mark.parametrize(
    ("log", "words"),
    [
        (DrillLog([1, 1, 1], [0, 0, 0]), "a drill of level 1 alone, there is nothing to climb"),
        (DrillLog([1, 2, 2, 2], [1, 1, 1, 1]), "You never missed, so your log cannot tell yet"),
        (DrillLog([2, 3], [1, 0]), "It is the only level that you missed."),
        (DrillLog([1, 3], [1, 0], session=[1, 2]), "No level that you missed would lift"),
    ],
)
def test_nobody_is_sure_of_what_a_log_cannot_tell(log: DrillLog, words: str) -> None:
    shown = told(analyse_log(log, rng=np.random.default_rng(1), replicas=9))
    assert words in shown
    assert "sure" not in shown


def test_a_level_that_nobody_tried_is_named(analysis: LogAnalysis) -> None:
    assert "never tried" not in told(analysis)
    rng = np.random.default_rng(1)
    gap = DrillLog([2, 1, 5, 4], [0, 1, 0, 1], session=[1, 1, 2, 2])
    assert "You never tried level 3: it counts as" in told(analyse_log(gap, rng=rng, replicas=9))
    higher = DrillLog([3, 2], [0, 1], levels=5)
    assert "You never tried level 4: it counts as" in told(analyse_log(higher, rng=rng, replicas=9))
