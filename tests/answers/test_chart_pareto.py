from evenbreak.answers.chart_design import DesignTask
from evenbreak.answers.chart_pareto import chart_pareto_answer
from evenbreak.handicaps import MatchRules, RaceLimits, chart, pareto

LIMITS = RaceLimits((5, 7), weaker_least=2)


def answer_of(*beside, rule="mean"):
    task = DesignTask(MatchRules("npl"), LIMITS, rule=rule, beside=beside)
    charts = pareto("npl", LIMITS, beside=beside, criterion=rule)
    return charts, chart_pareto_answer(task, charts)


def test_json_has_every_chart_with_its_measures():
    charts, answer = answer_of(chart("npl_8"))
    found = answer.to_dict()
    assert found["up_to"] == charts[0].measure.up_to
    assert [one["chart"] for one in found["charts"]] == [one.chart.name for one in charts]
    for one, row in zip(charts, found["charts"], strict=True):
        assert row["worst_unfairness"] == one.measure.worst_unfairness
        assert (row["races"], row["beaten_by"]) == (len(one.chart.rows), one.beaten_by)


def test_nothing_is_beaten_without_a_chart_beside():
    for beside, shown in (((), False), ((chart("npl_8"),), True)):
        _, answer = answer_of(*beside)
        table = next(part for part in answer.parts if not isinstance(part, str))
        assert ("beaten by" in [column.words for _, column in table.shown()]) is shown
        assert ("npl_8" in answer.sentences[0]) is shown


def test_the_fairest_is_by_the_criterion():
    for rule in ("mean", "worst"):
        charts, answer = answer_of(rule=rule)
        least = min(getattr(one.measure, f"{rule}_unfairness") for one in charts)
        assert f"{100 * least:.1f} percentage points" in answer.sentences[0]
