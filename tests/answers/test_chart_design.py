from dataclasses import asdict

import pytest

from evenbreak.answers.chart_design import MOST_LISTED, DesignTask, chart_design_answer
from evenbreak.games import winner_breaks
from evenbreak.handicaps import (
    MatchRules,
    RaceLimits,
    chart,
    design,
    last_difference,
    measure_chart,
    nearest_chart,
)

NPL = MatchRules("npl")
LIMITS = RaceLimits((5, 7), weaker_least=2)


def tables(answer):
    return [part for part in answer.parts if not isinstance(part, str)]


def test_the_rule_decides_which_chart_is_made():
    assert DesignTask(NPL, LIMITS).design()[0] == design("npl", LIMITS)
    nearest = DesignTask(NPL, LIMITS, rule="nearest").design()[0]
    assert nearest.rows == nearest_chart("npl", LIMITS).rows


def test_the_last_difference_comes_from_the_charts_beside():
    beside = (chart("npl_8"), chart("npl_12"))
    made = DesignTask(NPL, LIMITS, beside=beside).design()
    assert made[1] == min(last_difference(one, NPL) for one in beside)
    assert DesignTask(NPL, LIMITS, up_to=30, beside=beside).design()[1] == 30


def test_json_has_the_chart_and_its_measures():
    task = DesignTask(NPL, LIMITS, beside=(chart("npl_8"),))
    made = task.design()
    answer = chart_design_answer(task, made).to_dict()
    ours, theirs = (measure_chart(one, NPL, up_to=52) for one in (made[0], chart("npl_8")))
    for row, shown in zip(made[0].rows, answer["rows"], strict=True):
        assert row._asdict().items() <= shown.items()
        assert 0.0 < shown["p_win_low"] < shown["p_win_high"] < 1.0
    assert {name: answer[name] for name in asdict(ours)} == asdict(ours)
    (beside,) = answer["beside"]
    assert {name: beside[name] for name in asdict(theirs)} == asdict(theirs)
    for span in beside["other_races"]:
        where = span["difference_from"]
        assert span["design"] == "{}:{}".format(*made[0].race(where))
        assert span["beside"] == "{}:{}".format(*chart("npl_8").race(where))


def test_a_chart_beside_itself_has_no_other_races():
    task = DesignTask(NPL, LIMITS)
    made = task.design()
    same = DesignTask(NPL, LIMITS, beside=(made[0],))
    answer = chart_design_answer(same, made)
    assert answer.to_dict()["beside"][0]["other_races"] == []
    assert len(tables(answer)) == 1


def test_a_person_sees_the_first_of_many_other_races():
    task = DesignTask(NPL, RaceLimits((17, 41), weaker_least=2), rows=10, beside=(chart("npl_20"),))
    answer = chart_design_answer(task, task.design())
    shown = list(tables(answer)[-1].rows)
    every = answer.to_dict()["beside"][0]["other_races"]
    assert len(shown) == MOST_LISTED < len(every)
    assert str(len(every)) in tables(answer)[-1].title


def test_games_are_those_of_the_rules():
    rules = MatchRules("npl", win_by=2, breaks=winner_breaks, break_points=10)
    task = DesignTask(rules, RaceLimits((5, 6)), up_to=20)
    made = task.design()
    rows = list(tables(chart_design_answer(task, made))[0].rows)
    race = made[0].rows[0][2:]
    ends = [made[0].rows[0].difference_from, made[0].rows[0].difference_to]
    assert rows[0][1] == race
    assert rows[0][3] == pytest.approx(rules.win([race[0]], [race[1]], ends)[0, 1])
    assert rows[0][5] == rules.games_quantile(*race, ends, 0.9).max()


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({}, ["5 to 7", "30 points", "0 to 52"]),
        ({"rules": MatchRules("fargo", win_by=2)}, ["100 points", "won by 2"]),
        ({"limits": RaceLimits((5, 7), games_p90=6)}, ["within 6"]),
        ({"rows": 1}, ["1 row"]),
        ({"mean_games": 4.5}, ["4.5 games"]),
        ({"target": 0.55, "tilt": 0.25}, ["55%", "tilt 0.25"]),
    ],
)
def test_the_heading_says_what_was_asked(changes, words):
    heading = DesignTask(**{"rules": NPL, "limits": LIMITS, **changes}).heading(52)
    for word in words:
        assert word in heading
