"""`sandbag watch` under levels and refits: who dumps is found, honest players are not flagged."""

import json

import numpy as np
import pytest

from evenbreak.handicaps import level_skills

PLAYERS, WEEKS = 10, 30


def write_league(folder, rng, *, dumps):
    """Write a list and a season by the APA's chart; the first player may dump every other week."""
    skills = level_skills("apa_8ball")
    names, levels = [f"P{k}" for k in range(PLAYERS)], rng.integers(3, 7, PLAYERS)
    rows = [f"{n},{k},{400 + skills.strength(k):.0f}" for n, k in zip(names, levels, strict=True)]
    (folder / "list.csv").write_text("\n".join(["player,skill level,fargo rating", *rows]))
    lines = ["date,player_a,player_b,score_a,score_b,race_a,race_b"]
    for week in range(WEEKS):
        day = np.datetime64("2026-01-06") + np.timedelta64(7 * week, "D")
        for a, b in rng.permutation(PLAYERS).reshape(-1, 2).tolist():
            m, n = skills.chart.race(int(levels[a]), int(levels[b]))
            p = float(skills.chance(levels[a], levels[b]))
            if dumps and week % 2 and 0 in (a, b):
                p = 0.1 if a == 0 else 0.9
            x = y = 0
            while x < m and y < n:
                won = rng.random() < p
                x, y = x + won, y + (not won)
            lines.append(f"{day},{names[a]},{names[b]},{x},{y},{m},{n}")
    (folder / "season.csv").write_text("\n".join(lines) + "\n")


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("system", ["level-review", "level-steps", "fargo-like"])
@pytest.mark.parametrize("dumps", [True, False], ids=["dumped", "honest"])
def test_most_evidence_is_against_who_dumps_and_honest_players_are_not_flagged(
    run, tmp_path, system, dumps
):
    write_league(tmp_path, np.random.default_rng(3), dumps=dumps)
    words = ("--roster", str(tmp_path / "list.csv"), "--system", system, "--json")
    found = run("sandbag", "watch", str(tmp_path / "season.csv"), *words)
    assert found.exit_code == 0, found.stderr
    players = json.loads(found.stdout)["players"]
    if dumps:
        assert max(players, key=lambda row: row["largest_e"])["player"] == "P0"
        assert max(row["largest_e"] for row in players) > 10.0
    else:
        assert not [row["player"] for row in players if row["flagged"]]


def test_a_system_whose_numbers_say_nothing_of_strength_is_refused(run, tmp_path):
    write_league(tmp_path, np.random.default_rng(3), dumps=False)
    words = ("--roster", str(tmp_path / "list.csv"), "--system")
    none = run("sandbag", "watch", str(tmp_path / "season.csv"), *words, "none")
    assert none.exit_code == 2
    assert "no scale" in none.stderr
    scaled = run(
        "sandbag", "watch", str(tmp_path / "season.csv"), *words, "tap-like", "--scale", "30"
    )
    assert "Leave it out" in scaled.stderr
