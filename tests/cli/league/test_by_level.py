"""Score sheets that state skill levels but no races, in every command that reads results."""

import csv
import json
import math
import re

import pytest

from evenbreak.handicaps import Gap, level_skills
from offices import apa_office

HEADER = "date,player_a,player_b,score_a,score_b,level_a,level_b\n"
NIGHTS = [
    f"2026-01-{day:02d},{a},{b},{score}"
    for day in (6, 13, 20)
    for a, b, score in (
        ("Ann", "Bo", "4,1,5,3"),
        ("Cy", "Ann", "2,4,3,5"),
        ("Bo", "Cy", "1,2,3,3"),
        ("Di", "Ann", "2,3,4,5"),
        ("Di", "Bo", "3,1,4,3"),
    )
]


@pytest.fixture
def sheet(tmp_path):
    path = tmp_path / "sheet.csv"
    path.write_text(HEADER + "".join(row + "\n" for row in NIGHTS))
    return str(path)


def answer(run, *words):
    result = run(*words, "--json")
    assert result.exit_code == 0, result.stderr
    return json.loads(result.stdout), result.stderr


def test_a_chart_knows_who_won(run, sheet):
    found, told = answer(run, "why", "Ann", "Bo", "--results", sheet, "--chart", "apa_8ball")
    assert "get their races f" in told
    assert {row["result"] for row in found["matches"]} == {"won", "lost"}
    assert (found["chart_race_a"], found["chart_race_b"]) == (4, 2)
    assert found["chart_p_win_a"] == pytest.approx(level_skills("apa_8ball").gap(5, 3).win(4, 2))
    words = run("why", "Ann", "Bo", "--results", sheet, "--chart", "apa_8ball").stderr
    by_level, by_ratings = (
        words.index("In apa_8ball, their race is 4:2"),
        words.index("own results"),
    )
    assert by_level < by_ratings
    rated = re.search(r"Ann would win the 4:2 race (\d+)% of the time", " ".join(words.split()))
    gap = Gap(found["difference"], found["difference_error"], "fargo")
    assert int(rated[1]) == round(100 * float(gap.win(4, 2)))


@pytest.mark.slow
def test_why_matchups_and_the_site_give_a_pair_one_race_and_chance(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    apa_office(tmp_path)
    assert run("league", "init", "--yes").exit_code == 0
    assert run("publish", "--out", "site").exit_code == 0
    rows = csv.DictReader(run("matchups", "--csv").stdout.splitlines())
    for row in [*rows][::13]:
        names = row["player_a"], row["player_b"]
        found, _ = answer(run, "why", *names)
        race = found["chart_race_a"], found["chart_race_b"]
        assert race == (int(row["chart_race_a"]), int(row["chart_race_b"]))
        assert found["chart_p_win_a"] == pytest.approx(float(row["chart_p_win_a"]), abs=1e-6)
        page = tmp_path / "site" / "players" / f"{names[0].lower().replace(' ', '-')}.html"
        text = " ".join(re.sub(r"<[^>]+>", " ", page.read_text()).split())
        assert f"{names[1]} {race[0]}:{race[1]} {100 * found['chart_p_win_a']:.0f}%" in text


@pytest.mark.slow
def test_points_of_levels_are_fargo_points_in_every_command(run, sheet):
    for more, points in ((("--chart", "apa_8ball"), 100), ((), 30)):
        for words in (("rate",), ("why", "Ann", "Bo", "--results")):
            text = " ".join(run(*words, sheet, *more, "--text").stdout.split())
            assert f"({points} points double the odds)" in text
        validated = run("validate", sheet, *more, "--prior", str(points), "--csv").stdout
        assert re.search(rf"prior_sd,game,plug-in,\d+,,{math.log(2):.6f}", validated)


@pytest.mark.parametrize("words", [("rate",), ("validate",), ("report", "--out", "sheet")])
def test_each_command_that_reads_results_takes_the_chart(run, sheet, words):
    result = run(*words, sheet, "--chart", "apa_8ball")
    assert result.exit_code == 0, result.stderr
    assert "get their races f" in result.stderr
    assert "without a winner" not in result.stderr


def test_a_chart_of_differences_goes_by_the_ratings(run, sheet):
    found, _ = answer(run, "why", "Ann", "Bo", "--results", sheet, "--chart", "npl_8")
    assert found["chart_race_a"] >= found["chart_race_b"]


@pytest.mark.slow
def test_lists_that_lack_a_level_or_a_player_take_them_from_the_results(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    sheet = [row.replace("Ann", "Mike Morris") for row in NIGHTS]
    (tmp_path / "sheet.csv").write_text(HEADER + "".join(row + "\n" for row in sheet))
    roster = tmp_path / "roster.csv"
    roster.write_text("player,level\nMichael Morris,5\nBo,\nCy,4\nDi,3\nNew,\n")
    words = ("matchups", "roster.csv", "--chart", "apa_8ball", "--results", "sheet.csv")
    assert "'New' has no skill level" in run(*words).stderr
    found, _ = answer(run, *words, "--starter", "2")
    taken = [
        one
        for one in found["warnings"]
        if "Bo 3" in one or "No level is known for New; it is assumed to be 2" in one
    ]
    assert len(taken) == 2
    race = {(row["player_a"], row["player_b"]): row for row in found["pairs"]}
    one = next(row for pair, row in race.items() if set(pair) == {"Michael Morris", "Bo"})
    assert {one["chart_race_a"], one["chart_race_b"]} == {4, 2}
    (tmp_path / "league.toml").write_text(
        'chart = "apa_8ball"\n[files]\nroster = "roster.csv"\n[[results]]\nfile = "sheet.csv"\n'
    )
    tidied, _ = answer(run, "league", "tidy", "--out", "tidy.csv")
    assert tidied["not_on_roster"] == [
        {"name": "Mike Morris", "matches": 9, "nearest_name": "Michael Morris"}
    ]
    assert tidied["roster_aliases"] == [{"line": '"Mike Morris" = "Michael Morris"'}]
