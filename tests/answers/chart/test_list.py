from evenbreak.answers.chart.show import chart_list_answer
from evenbreak.handicaps import EVERY_CHART


def test_every_chart_is_listed_with_its_title():
    rows = chart_list_answer().to_dict()["charts"]
    assert {row["chart"]: row["what"] for row in rows} == EVERY_CHART


def test_the_races_of_a_chart_are_counted_once():
    rows = {row["chart"]: row for row in chart_list_answer().to_dict()["charts"]}
    assert (rows["npl_8"]["races"], rows["npl_8"]["longest_games"]) == (6, 7)
    assert (rows["apa_8ball"]["even_race_from"], rows["apa_8ball"]["even_race_to"]) == (2, 5)
    assert rows["apa_9ball"]["races"] is None
    assert (rows["apa_8ball"]["races"], rows["apa_8ball"]["longest_games"]) == (12, 9)
