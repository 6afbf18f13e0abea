"""Score sheets that state skill levels but no races, in every command that reads results."""

import json

import pytest

from evenbreak.handicaps import Gap

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
    assert "are those of apa_8ball" in told
    assert {row["result"] for row in found["matches"]} == {"won", "lost"}
    assert (found["chart_race_a"], found["chart_race_b"]) == (4, 2)
    gap = Gap(found["difference"], found["difference_error"], "npl")
    assert found["chart_p_win_a"] == pytest.approx(gap.win(4, 2), abs=1e-6)
    words = run("why", "Ann", "Bo", "--results", sheet, "--chart", "apa_8ball").stderr
    assert "By apa_8ball the race of levels 5 and 3 is 4:2" in words


@pytest.mark.parametrize("words", [("rate",), ("validate",), ("report", "--out", "sheet")])
def test_each_command_that_reads_results_takes_the_chart(run, sheet, words):
    result = run(*words, sheet, "--chart", "apa_8ball")
    assert result.exit_code == 0, result.stderr
    assert "are those of apa_8ball" in result.stderr
    assert "without a winner" not in result.stderr


def test_a_chart_of_differences_goes_by_the_ratings(run, sheet):
    found, _ = answer(run, "why", "Ann", "Bo", "--results", sheet, "--chart", "npl_8")
    assert found["chart_race_a"] >= found["chart_race_b"]
