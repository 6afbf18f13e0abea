"""`evenbreak sandbag watch` on lists of any scale: the honest are left alone, or it refuses."""

import csv
from pathlib import Path

import numpy as np
import pytest

from evenbreak.ratings.scale import SCALES

ROUNDS = 2
"""How often every two players meet."""


def honest_league(folder: Path, title: str, scale: str) -> tuple[str, str]:
    """Write results of a dozen players whose ratings are right, and their list."""
    rng, points = np.random.default_rng(5), SCALES[scale]
    steps = np.linspace(-1.6, 1.6, 12) * points.points_per_doubling
    rating = np.round(points.center + steps).astype(int)
    rows = []
    for turn in range(ROUNDS):
        for a in range(12):
            for b in range(a):
                p = float(points.win_probability(float(rating[a] - rating[b])))
                score = [0, 0]
                while max(score) < 5:
                    score[int(rng.random() >= p)] += 1
                rows.append((f"2025-{turn + 1:02}-{a + 1:02}", f"P{a}", f"P{b}", *score, 5, 5))
    roster, results = folder / "start.csv", folder / "season.csv"
    listed = "".join(f"P{k},{points}\n" for k, points in enumerate(rating))
    roster.write_text(f"player,{title}\n{listed}", encoding="utf-8")
    header = "date,player_a,player_b,score_a,score_b,race_a,race_b\n"
    lines = "".join(",".join(map(str, row)) + "\n" for row in sorted(rows))
    results.write_text(header + lines, encoding="utf-8")
    return str(results), str(roster)


@pytest.mark.slow_after(2)
@pytest.mark.parametrize(
    ("title", "scale", "words"),
    [
        ("Rating", "fargo", ()),
        ("Fargo Rating", "fargo", ()),
        ("Rating", "fargo", ("--scale", "fargo")),
        ("Rating", "npl", ()),
    ],
)
def test_honest_players_are_not_flagged_on_any_scale(run, tmp_path, title, scale, words):
    results, roster = honest_league(tmp_path, title, scale)
    told = run("sandbag", "watch", results, "--roster", roster, *words)
    assert told.exit_code == 0, told.stderr
    flagged = [
        row["player"] for row in csv.DictReader(told.stdout.splitlines()) if row["flagged"] == "yes"
    ]
    assert flagged == []


@pytest.mark.parametrize("title", ["Rating", "Fargo Rating"])
def test_a_scale_that_the_list_contradicts_is_refused(run, tmp_path, title):
    results, roster = honest_league(tmp_path, title, "fargo")
    told = run("sandbag", "watch", results, "--roster", roster, "--scale", "npl")
    if title == "Rating":
        assert told.exit_code == 0
        assert "the results don't fit NPL ratings: the higher-rated player won" in told.stderr
    else:
        assert told.exit_code == 2
        assert "states that its ratings are on the Fargo scale" in told.stderr


def test_a_list_that_states_the_wrong_scale_is_refused_with_both_readings(run, tmp_path):
    results, roster = honest_league(tmp_path, "Rating", "fargo")
    first, *rows = Path(roster).read_text(encoding="utf-8").splitlines()
    Path(roster).write_text("\n".join([f"{first},scale", *(f"{row},npl" for row in rows)]))
    told = run("sandbag", "watch", results, "--roster", roster)
    assert told.exit_code == 2
    (line,) = told.stderr.splitlines()[-1:]
    assert "the results don't fit NPL ratings" in line
    assert "and Fargo ratings predict" in line
    assert "--scale fargo" in line
