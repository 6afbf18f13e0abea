from dataclasses import asdict, replace

import pytest

from evenbreak.answers.chart.design import MOST_LISTED, DesignTask, chart_design_answer
from evenbreak.handicaps import RaceLimits, chart, design, last_difference, measure_chart
from evenbreak.handicaps.charts.race_grid import games_quantiles, win_grid
from evenbreak.ratings import SCALES

NPL = SCALES["npl"]
LIMITS = RaceLimits((5, 7), weaker_least=2)


def tables(answer):
    return [part for part in answer.parts if not isinstance(part, str)]


def test_it_is_the_design_of_the_library():
    assert DesignTask(NPL, LIMITS).design()[0] == design("npl", LIMITS, spread=2)


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


def test_chances_and_lengths_are_those_of_the_range():
    task = DesignTask(NPL, RaceLimits((5, 6)), up_to=20)
    made = task.design()
    rows = list(tables(chart_design_answer(task, made))[0].rows)
    start, end, *race = made[0].rows[0]
    assert rows[0][1] == tuple(race)
    assert rows[0][3] == win_grid(NPL, [race[0]], [race[1]], [start, end])[0, 1]
    assert rows[0][5] == games_quantiles(NPL, *race, [start, end], 0.9).max()


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({}, ["5 to 7", "30 points", "0 to 52"]),
        ({"scale": SCALES["fargo"]}, ["100 points"]),
        ({"limits": RaceLimits((5, 7), games_p90=6)}, ["within 6"]),
        ({"rows": 1}, ["1 row"]),
        ({"limits": RaceLimits((5, 9))}, ["2 games apart"]),
        ({"target": 0.55, "tilt": 0.25}, ["55%", "tilt 0.25"]),
    ],
)
def test_the_heading_says_what_was_asked(changes, words):
    heading = DesignTask(**{"scale": NPL, "limits": LIMITS, **changes}).heading(52)
    for word in words:
        assert word in heading


WISHES = DesignTask(NPL, RaceLimits((5, 15), 2, 2), rows=11, up_to=90)


def prices_of(task):
    return chart_design_answer(task, task.design()).to_dict().get("prices", [])


def test_each_wish_is_left_out_once():
    this, free, *_ = prices_of(WISHES)
    for shown, task in ((this, WISHES), (free, replace(WISHES, rows=None))):
        made, _ = task.design()
        measured = measure_chart(made, "npl", up_to=90)
        assert shown["mean_unfairness"] == measured.mean_unfairness
        assert shown["rows"] == len(made.rows)


def test_shorter_matches_are_less_fair():
    *_, shorter, shortest = prices_of(WISHES)
    assert shorter["games_p90"] > shortest["games_p90"]
    assert shorter["mean_unfairness"] < shortest["mean_unfairness"]


def test_nothing_is_listed_where_no_wish_costs_anything():
    assert prices_of(replace(WISHES, limits=RaceLimits((5, 7), 2, 2))) == []
