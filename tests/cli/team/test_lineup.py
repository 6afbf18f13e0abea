"""The captain's questions through the command line."""

import pytest

from places import DATA
from rows import each_of

TEAMS = (str(DATA / "demo_team.csv"), str(DATA / "demo_opponents.csv"))


@pytest.mark.slow
def test_the_keys_and_the_best_pick(ask):
    told = ask("lineup", *TEAMS, "--race", "5", "--order", "ABABA")
    assert told["best"] == told["options"][0]["name"]
    assert told["p_win"] == told["options"][0]["p_win"] == told["toss"]["name_first"]
    assert len(told["options"]) == 6
    assert {row["order"] for row in told["orders"]} >= {"ABABA", "BABAB", "====="}
    by_cost = [row["cost"] for row in told["options"]]
    assert by_cost == sorted(by_cost)


def test_going_on_from_the_middle(ask):
    asked = ("--race", "5", "--sure", "--used", "ines valbrecht,Pia Rautavuori", "--score", "1:0")
    theirs = ask("lineup", *TEAMS, *asked)
    assert not theirs["ours"]
    assert theirs["set"] == 2
    named = theirs["options"][0]["name"]
    ours = ask("lineup", *TEAMS, *asked, "--named", named)
    assert ours["ours"]
    assert ours["best"] == theirs["options"][0]["answer"]
    assert ours["p_win"] == pytest.approx(theirs["p_win"])


def test_a_match_that_is_being_played(ask):
    ahead, behind = (
        ask(
            "lineup",
            *TEAMS,
            "--race",
            "5",
            "--sure",
            "--playing",
            f"Dario Pellengrino v Pia Rautavuori {s}",
        )
        for s in ("4:0", "0:4")
    )
    assert ahead["p_win"] > behind["p_win"]


def test_caps_keep_the_strong_ones_apart(ask):
    free, capped = (
        ask("lineup", *TEAMS, "--race", "5", "--sure", *more)["p_win"]
        for more in ((), ("--cap", "23", "--at-most", "2:6"))
    )
    assert capped < free


def test_sealed_and_blind_are_worth_the_same(ask):
    values = [
        ask("lineup", *TEAMS, "--race", "5", "--sure", "--order", order)["p_win"]
        for order in ("sealed", "blind")
    ]
    assert values[0] == pytest.approx(values[1], abs=1e-9)


@each_of(
    "options, what",
    [
        ("", "Error: Add a race"),
        ("--race 5 --order XYZ", "XYZ"),
        ("--race 5 --cap 10", "sum of the levels to 10"),
        ("--race 5 --at-most two", "'two'"),
        ("--race 5 --doubles 7", "7"),
        ("--race 5 --used Nobody --score 1:0", "Nobody"),
        ("--race 5 --used Ines~Valbrecht", "--score"),
        ("--race 5 --playing Ines", "Ines"),
        ("--race 5 --score 1:0 --used Ines~Valbrecht", "both sides"),
        ("--race 5 --score 0:0 --used Ines~Valbrecht,Pia~Rautavuori", "0-0"),
        ("--race 5 --score 2:1 --used Ines~Valbrecht,Pia~Rautavuori", "2-1"),
        ("--race 5 --count games --score 3:3 --used Ines~Valbrecht,Pia~Rautavuori", "3-3"),
        ("--race 5 --last won", "--last"),
        ("--race 5 --order sealed --score 1:0 --used Ines~Valbrecht,Pia~Rautavuori", "sealed"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(run, options, what):
    result = run("lineup", *TEAMS, *(word.replace("~", " ") for word in options.split()))
    assert result.exit_code in (1, 2, 3)
    assert what in result.stderr.splitlines()[-1]


@pytest.mark.slow
def test_who_has_no_rating_is_said(run, tmp_path):
    ours = tmp_path / "ours.csv"
    ours.write_text("player,rating,scale\nAnn,600,fargo\nBo,,fargo\n")
    result = run("lineup", str(ours), TEAMS[1], "--race", "5", "--text")
    assert "Bo" in result.stderr


AFTER_ONE = ("--race", "5", "--sure", "--used", "dario,winston")


@pytest.mark.parametrize(
    "words",
    [
        ("--score", "1:0"),
        ("--score", "0:1", "--order", "AL", "--last", "lost"),
        ("--count", "games", "--score", "5:2"),
        ("--count", "points", "--score", "1:2"),
    ],
)
def test_scores_that_can_be_go_on(ask, words):
    assert ask("lineup", *TEAMS, *AFTER_ONE, *words)["set"] == 2


@pytest.mark.parametrize(
    ("words", "what"),
    [
        (("--score", "2:0"), "2-0 is impossible"),
        (("--score", "1:1"), "1 set is over"),
        (("--count", "games", "--score", "3:0"), "3-0 is impossible"),
        (("--count", "games", "--score", "5:5"), "5-5 is impossible"),
        (("--count", "points", "--score", "1:1"), "1-1 is impossible"),
        (("--score", "1:0", "--order", "AL", "--last", "lost"), "--last lost contradicts"),
        (("--score", "1:0", "--named", "nobody"), "neither team"),
    ],
)
def test_scores_that_cannot_be_are_refused(run, words, what):
    result = run("lineup", *TEAMS, *AFTER_ONE, *words)
    assert result.exit_code == 2
    assert what in result.stderr
