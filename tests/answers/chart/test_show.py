import pytest

from evenbreak.answers.chart.show import chart_show_answer
from evenbreak.files.charts import chart_table
from evenbreak.handicaps import Chart, LevelChart, chart, level_chart


@pytest.mark.parametrize("one", [chart("npl_12"), level_chart("apa_8ball")], ids=lambda c: c.name)
def test_the_csv_is_a_chart_file(one):
    columns, rows = chart_table(one)
    frame = chart_show_answer(one).to_frame()
    assert list(frame.columns) == columns
    assert len(frame) == len(rows)
    assert chart_show_answer(one).to_dict()["rows"][0] == dict(zip(columns, rows[0], strict=True))


def test_a_chart_of_one_race_needs_no_second_sentence():
    answer = chart_show_answer(Chart("even", [(0, None, 5, 5)]))
    assert "5" in answer.sentences[0]
    assert "49" not in answer.sentences[0]
    assert "from" not in answer.sentences[0].lower()


def test_levels_make_a_square():
    answer = chart_show_answer(LevelChart("two", [3, 4], [[2, 2], [3, 3]]))
    (square,) = [part for part in answer.parts if not isinstance(part, str)]
    assert [list(row) for row in square.rows] == [[3, (2, 2), (2, 3)], [4, (3, 2), (3, 3)]]


def test_warnings_of_the_file_are_handed_on():
    assert chart_show_answer(chart("npl_8"), warnings=["odd file"]).warnings == ["odd file"]
