from evenbreak.answers.chart.audit import points_audit_answer
from evenbreak.handicaps import PointsChart, audit_points, points_chart


def test_json_has_all_pairs_and_the_assumption():
    found = points_audit_answer(points_chart("apa_9ball")).to_dict()
    report = audit_points(points_chart("apa_9ball"))
    assert found["innings"] == report.innings
    assert [one["p_win"] for one in found["pairs"]] == [one.p_win for one in report.pairs]
    assert found["levels"][0]["p_win_as_next"] == report.levels[0].p_win_as_next


def test_a_single_level_has_nothing_to_compare():
    answer = points_audit_answer(PointsChart("one", [5], [38]))
    assert "single level" in answer.sentences[0]
