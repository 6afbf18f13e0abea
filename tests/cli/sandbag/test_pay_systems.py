"""`sandbag pay` under systems without points by match: solved by a chain, or played."""

import json

import pytest

from evenbreak.handicaps import LevelLadder, level_skills, system_of


def paid(run, *words):
    found = run("sandbag", "pay", *words, "--json")
    assert found.exit_code == 0, found.stderr
    return json.loads(found.stdout)


def test_levels_in_steps_are_solved(run):
    answer = paid(run, "--chart", "apa_8ball", "--dumped", "5")
    points = level_skills("apa_8ball").points
    ladder = LevelLadder(system_of("level-steps"), float(points[3]), (0, 0, 0, 1, 0, 0))
    expected = ladder.dumping(5, 20)
    assert answer["leagues"] == 0
    assert [row["extra_wins"] for row in answer["rows"]] == pytest.approx(
        [row.extra_wins for row in expected]
    )


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("system", ["fargo-like", "tap-like", "averages correction=2"])
def test_other_systems_are_played_with_a_stated_error(run, system):
    answer = paid(run, "--system", system, "--dumped", "6", "--earnest", "6")
    assert answer["leagues"] == 1000
    rows = {row["dumped"]: row for row in answer["rows"]}
    assert rows[0]["extra_wins"] == rows[0]["error"] == 0.0
    assert 0.0 <= rows[6]["error"] < 0.05
    text = run("sandbag", "pay", "--system", system, "--dumped", "2", "--earnest", "3").stderr
    assert "±" in " ".join(text.split())


@pytest.mark.parametrize("option", ["--compare", "--start-error=-5"])
def test_what_only_points_by_match_have_is_refused(run, option):
    found = run("sandbag", "pay", "--system", "fargo-like", option)
    assert found.exit_code == 2
    assert "Leave it out" in found.stderr
