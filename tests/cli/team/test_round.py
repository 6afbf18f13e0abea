"""A round of two teams through the command line."""

import pytest

from places import DATA

OURS, THEIRS = str(DATA / "demo_team.csv"), str(DATA / "demo_opponents.csv")


def test_a_head_start_makes_a_round_more_even(ask):
    told = ask("round", OURS, THEIRS, "--single-games", "1", "--everybody", "--sure")
    plain, *more = told["starts"]
    assert plain["start_1"] == 0
    assert sum(plain[key] for key in ("p_win_1", "p_tie", "p_lose_1")) == pytest.approx(1.0)
    [fair] = [row for row in more if row["start_1"] == told["fair_start_1"]]
    assert abs(fair["p_win_1"] - fair["p_lose_1"]) < abs(plain["p_win_1"] - plain["p_lose_1"])


@pytest.mark.parametrize(
    ("words", "what"),
    [
        ([], "--single-games"),
        (["--single-games", "2", "--race", "5"], "the races are given twice"),
        (["--single-games", "2"], "6 players"),
    ],
)
def test_a_wrong_question_is_refused(run, words, what):
    result = run("round", OURS, THEIRS, *words)
    assert result.exit_code == 2
    assert what in result.stderr
