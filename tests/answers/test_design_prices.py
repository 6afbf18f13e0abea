from dataclasses import replace

from evenbreak.answers.chart_design import DesignTask
from evenbreak.answers.design_prices import design_prices
from evenbreak.handicaps import MatchRules, RaceLimits, measure_chart

TASK = DesignTask(MatchRules("npl"), RaceLimits((5, 15), 2, 2), rows=11, spread=2, up_to=90)


def rows_of(task):
    table = design_prices(task, *task.design())
    return [] if table is None else table.to_dicts()


def test_each_wish_is_left_out_once():
    this, free, lengths, *_ = rows_of(TASK)
    for found, task in (
        (this, TASK),
        (free, replace(TASK, rows=None)),
        (lengths, replace(TASK, spread=None)),
    ):
        made, _ = task.design()
        measured = measure_chart(made, "npl", up_to=90)
        assert found["mean_unfairness"] == measured.mean_unfairness
        assert found["rows"] == len(made.rows)


def test_shorter_matches_are_less_fair():
    *_, shorter, shortest = rows_of(TASK)
    assert shorter["games_p90"] > shortest["games_p90"]
    assert shorter["mean_unfairness"] < shortest["mean_unfairness"]


def test_nothing_is_listed_where_no_wish_costs_anything():
    assert rows_of(replace(TASK, limits=RaceLimits((5, 7), 2, 2))) == []
    assert rows_of(replace(TASK, rule="nearest", rows=None, spread=None)) == []
