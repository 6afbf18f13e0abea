from evenbreak.handicaps import RaceLimits, chart, pareto
from evenbreak.plots.pareto_front import pareto_figure

PRINTED = [chart("npl_8"), chart("npl_20")]


def test_each_chart_is_a_point_and_the_beaten_ones_bear_their_names():
    charts = pareto("npl", RaceLimits((5, 9), weaker_least=2), beside=PRINTED, criterion="worst")
    (axes,) = pareto_figure(charts, criterion="worst").axes
    points = {tuple(point) for line in axes.lines for point in line.get_xydata().tolist()}
    assert points == {(one.measure.mean_games, one.measure.worst_unfairness) for one in charts}
    names = {text.get_text() for text in axes.texts}
    assert {"npl_8", "npl_20"} <= names
    assert "worst" in axes.get_ylabel()


def test_where_nothing_is_beaten_no_such_mark_is_explained():
    charts = pareto("npl", RaceLimits((5, 9), weaker_least=2))
    (axes,) = pareto_figure(charts).axes
    labels = [text.get_text() for text in axes.get_legend().texts]
    assert not any("fairer" in text for text in labels)
    assert "average" in axes.get_ylabel()
