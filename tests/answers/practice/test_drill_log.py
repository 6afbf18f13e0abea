from dataclasses import replace

import numpy as np
import pytest

from evenbreak.answers.practice.drill import drill_log_answer
from evenbreak.files.practice import DrillLogFile
from evenbreak.practice import DrillLog, LogAnalysis, PlayedAgainTest, analyze_log

LOG = DrillLog([1, 2, 3, 2, 3, 2, 1, 1, 2], [1, 1, 0, 1, 0, 0, 0, 1, 1])
UNLIKELY, LIKELY = PlayedAgainTest(0.25, 0.05, 0.001), PlayedAgainTest(0.25, 0.2, 0.4)


def analyzed(log: DrillLog) -> LogAnalysis:
    return analyze_log(log, rng=np.random.default_rng(1), replicas=99)


@pytest.fixture(scope="module")
def analysis() -> LogAnalysis:
    return analyzed(LOG)


def answer_of(analysis, log=LOG, **changes):
    file = DrillLogFile(log, "log.csv", ())
    return drill_log_answer(file, replace(analysis, **changes), seed=1)


def test_no_level_is_named_while_none_is_likely_to_be_it(analysis):
    levels = [one._replace(p_best=one.p_best and 0.36) for one in analysis.levels]
    said = answer_of(analysis, levels=tuple(levels)).sentences[0]
    assert said.startswith(
        "It is too early to tell which level to practice: the chance of being the best is 36% for "
        "level"
    )


def findings(analysis, **changes):
    return answer_of(analysis, **changes).sentences[1]


def test_json_has_every_number_of_the_analysis(analysis):
    found = answer_of(analysis).to_dict()
    assert [row["lift"] for row in found["drill_levels"]] == [one.lift for one in analysis.levels]
    assert found["difference"] == analysis.difference._asdict()
    assert found["model"] == analysis.model._asdict()
    assert (found["mean"], found["mean_low"]) == (analysis.implied.mean, analysis.mean_low)
    assert (found["attempts"], found["sessions"], found["replicas"]) == (9, 1, 99)


def test_what_chance_explains_is_no_finding(analysis):
    nothing = findings(analysis, difference=LIKELY, memory=LIKELY, model_test=LIKELY)
    for name in ("difference", "memory", "model_test"):
        likely = {"difference": LIKELY, "memory": LIKELY, "model_test": LIKELY, name: UNLIKELY}
        assert findings(analysis, **likely) != nothing


def test_a_memory_has_a_side(analysis):
    after_a_miss = findings(analysis, difference=LIKELY, model_test=LIKELY, memory=UNLIKELY)
    assert "After a miss" in after_a_miss
    other = PlayedAgainTest(-0.25, -0.02, 0.001)
    assert "After a success" in findings(
        analysis, difference=LIKELY, model_test=LIKELY, memory=other
    )


def test_the_level_out_of_line_is_named(analysis):
    off = analysis.furthest_off_model
    found = findings(analysis, difference=LIKELY, memory=LIKELY, model_test=UNLIKELY)
    assert f"Level {off.level}" in found
    assert f"{off.successes} of {off.attempts}" in found


def test_p_values_are_in_the_details_only(analysis):
    answer = answer_of(analysis)
    assert not any("p = " in sentence for sentence in answer.sentences)
    details = " ".join(part for part in answer.details if isinstance(part, str))
    for test in (analysis.difference, analysis.memory, analysis.model_test):
        assert f"p = {test.p_value:.2g}" in details


def test_misses_at_level_1_are_left_out_of_the_model(analysis):
    details = " ".join(part for part in answer_of(analysis).details if isinstance(part, str))
    assert "3 attempts there, 1 of them missed" in details


def test_an_unsure_advice_names_the_second_level(analysis):
    def advice(share):
        first, second, third = analysis.levels
        levels = (
            first._replace(p_best=0.0),
            second._replace(p_best=share),
            third._replace(p_best=1 - share),
        )
        return answer_of(analysis, levels=levels).sentences[0]

    assert "90%" in advice(0.9)
    assert "level 3" not in advice(0.9)
    assert "60%" in advice(0.6)
    assert "for level 3, that chance is 40%" in advice(0.6)


@pytest.mark.parametrize(
    "log",
    [
        DrillLog([1, 1, 1], [0, 0, 0]),
        DrillLog([1, 2, 2, 2], [1, 1, 1, 1]),
        DrillLog([1, 3], [1, 0], session=[1, 2]),
    ],
    ids=["level 1 alone", "never missed", "no lift"],
)
def test_a_log_that_cannot_advise_says_why(log):
    answer = answer_of(analyzed(log), log)
    assert answer.to_dict()["practice_next"] is None
    assert "chance" not in answer.sentences[0]


def test_the_only_level_missed_needs_no_certainty():
    answer = answer_of(analyzed(DrillLog([2, 3], [1, 0])), DrillLog([2, 3], [1, 0]))
    assert "level 3" in answer.sentences[0]
    assert "chance" not in answer.sentences[0]


@pytest.mark.parametrize(
    ("log", "level"),
    [
        (DrillLog([2, 1, 5, 4], [0, 1, 0, 1], session=[1, 1, 2, 2]), 3),
        (DrillLog([3, 2], [0, 1], levels=5), 4),
    ],
)
def test_the_first_untried_level_above_a_tried_one_is_named(log, level):
    assert f"not tried level {level}" in answer_of(analyzed(log), log).sentences[0]


def test_every_tried_level_needs_no_such_word(analysis):
    assert "not tried" not in answer_of(analysis).sentences[0]
