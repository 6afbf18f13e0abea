"""`evenbreak ladder --compare`: systems, charts and step sizes side by side."""

import csv
import io
from math import log10

import pytest

from evenbreak.answers.ladder.comparison import STEPS
from evenbreak.handicaps.ladders.ladder import Ladder
from evenbreak.handicaps.ladders.opponents import opponents_of, stretched
from places import DATA

ROSTER = DATA / "demo_roster.csv"
COMPARE_COLUMNS = (
    *("system", "chart", "sd", "sd_doublings", "settling_mean", "settling_p90"),
    *("p_favorite_mean", "favorite_over_60", "games_mean", "inflation", "on_front"),
    *("sd_se", "settling_mean_se"),
)


@pytest.mark.slow
def test_systems_side_by_side(compared):
    answer = compared("--chart", "npl_12", "--equal-skill")
    rows = {(row["system"], row["chart"]): row for row in answer["systems"]}
    assert all(tuple(row) == COMPARE_COLUMNS for row in rows.values())
    assert {chart for system, chart in rows if system == "npl"} == {
        "npl_8",
        "npl_10",
        "npl_12",
        "npl_20",
    }
    assert round(rows["npl", "npl_10"]["sd"], 3) == 4.417
    # A step of one is the league's own rule.
    own, step = rows["npl", "npl_12"], rows["step 1", "npl_12"]
    assert own["on_front"] is None
    assert {**own, "system": "step 1", "on_front": True} == step
    assert rows["step 2", "npl_12"]["sd"] > own["sd"]
    assert rows["step 2", "npl_12"]["settling_mean"] < own["settling_mean"]
    assert rows["elo 16", "fixed_9"]["sd_doublings"] < 1.0


@pytest.mark.slow
def test_a_row_of_the_comparison_says_what_the_ladder_says(ladder, compared):
    rows = compared()["systems"]
    (row,) = (row for row in rows if (row["system"], row["chart"]) == ("npl", "npl_10"))
    alone = ladder("--chart", "npl_10")
    assert row["sd"] == alone["sd"]
    assert row["settling_mean"] == alone["settling"]["mean"]
    assert row["p_favorite_mean"] == pytest.approx(alone["unfairness"]["favorite_mean"])


def test_no_step_of_the_front_is_beaten(compared):
    steps = [row for row in compared()["systems"] if row["on_front"] is not None]
    assert [row["system"] for row in steps] == [f"step {step}" for step in STEPS]
    for row in steps:
        beaten = any(
            other["sd"] < row["sd"] and other["settling_mean"] < row["settling_mean"]
            for other in steps
        )
        assert row["on_front"] is not beaten
    assert [row["system"] for row in steps if not row["on_front"]] == ["step 6"]


@pytest.mark.slow
def test_the_comparison_as_one_table_and_as_a_picture(run, tmp_path):
    path = tmp_path / "systems.svg"
    result = run("ladder", "--compare", "--plot", str(path))
    rows = list(csv.DictReader(io.StringIO(result.stdout)))
    assert tuple(rows[0]) == COMPARE_COLUMNS
    assert {row["on_front"] for row in rows} == {"", "0", "1"}
    assert "<svg" in path.read_text(encoding="utf-8")


@pytest.mark.slow
def test_refitted_ratings_are_simulated_beside_the_ladders(compared):
    rows = compared("--chart", "npl_12", "--equal-skill")["systems"]
    (refit,) = (row for row in rows if row["sd_se"])
    (npl,) = (row for row in rows if (row["system"], row["chart"]) == ("npl", "npl_10"))
    assert refit["system"] == "refit"
    # Newcomers come in sooner than step by step, and nobody is as far off as by longer steps.
    assert refit["settling_mean"] + 4.0 * refit["settling_mean_se"] < npl["settling_mean"]
    assert 4.0 < refit["sd"] - refit["sd_se"] < 6.2
    assert "refit" not in {row["system"] for row in compared()["systems"]}


@pytest.mark.parametrize(
    "words",
    [
        ("--system", "npl"),
        ("--step", "2"),
        ("--start-error", "3"),
        ("--newcomer",),
        ("--drift", "0.1"),
    ],
)
def test_what_a_comparison_cannot_take_is_refused(run, words):
    result = run("ladder", "--compare", *words)
    assert (result.exit_code, result.stdout) == (2, "")
    assert f"Leave {words[0]} out" in " ".join(result.stderr.split())


@pytest.mark.slow
def test_the_comparison_takes_a_league(ladder, compared):
    words = ("--chart", "npl_10", "--league", str(ROSTER), "--skill", "70")
    answer = compared(*words)
    rows = {(row["system"], row["chart"]): row for row in answer["systems"]}
    assert answer["opponents"] == "league"
    alone = ladder(*words)
    assert rows["npl", "npl_10"]["sd"] == alone["sd"]
    assert rows["npl", "npl_10"]["settling_mean"] == alone["settling"]["mean"]
    new = ladder(*words, "--newcomer")["settling"]["mean"]
    assert rows["npl new", "npl_10"]["settling_mean"] == new
    with ROSTER.open(encoding="utf-8") as file:
        ratings = [float(row["rating"]) for row in csv.DictReader(file) if row["rating"]]
    elo = Ladder("elo 4", opponents=stretched(opponents_of(ratings, 70), 400 * log10(2) / 30))
    assert rows["elo 4", "fixed_9"]["sd"] == elo.law().sd
