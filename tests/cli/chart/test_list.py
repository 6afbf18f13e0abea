import json

from evenbreak.handicaps import CHARTS, LEVEL_CHARTS, POINTS_CHARTS


def test_every_chart_is_listed_with_its_races(run):
    charts = json.loads(run("chart", "list", "--json").stdout)["charts"]
    by_name = {one["chart"]: one for one in charts}
    assert set(by_name) == {*CHARTS, *LEVEL_CHARTS, *POINTS_CHARTS}
    assert by_name["npl_20"]["longest_games"] == 19
    assert by_name["fargo_r6_hot"]["races"] == 7
    assert by_name["apa_8ball"]["looked_up_by"] == "skill level"


def test_csv_into_a_pipe(run):
    lines = run("chart", "list").stdout.splitlines()
    assert lines[0] == "chart,what,looked_up_by,even_race_from,even_race_to,longest_games,races"
    assert {line.count(",") for line in lines} == {6}


def test_there_is_nothing_to_name(run):
    result = run("chart", "list", "npl_8")
    assert (result.exit_code, result.stdout) == (2, "")
