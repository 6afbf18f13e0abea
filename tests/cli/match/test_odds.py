import csv
import json
import os
import re
import subprocess
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from places import DATA
from rows import each_of

KEYS = {
    "p_game_a",
    "p1",
    "p2",
    "p_win_a",
    "p_win_b",
    "p_never_ends",
    "mean_games",
    "sd_games",
    "games_p50",
    "games_p90",
    "p_hill_hill",
    "p_shutout_a",
    "p_shutout_b",
    "scale",
}
BREAKS = ["--p1", "0.6", "--p2", "0.5", "--breaks", "winner"]


@pytest.fixture
def odds(ask):
    def answer(line):
        told = ask("odds", *line.split())
        assert set(told) == KEYS
        return told

    return answer


def test_fargo_example(odds):
    answer = odds("612 521 --scale fargo --race 7:7")
    p = 1 / (1 + 2 ** (-91 / 100))
    assert answer["p_game_a"] == pytest.approx(p, rel=1e-14)
    assert answer["p_win_a"] == pytest.approx(0.874919, abs=5e-7)
    assert answer["p_win_a"] + answer["p_win_b"] == pytest.approx(1, rel=1e-14)
    assert answer["p_shutout_a"] == pytest.approx(p**7)
    assert answer["p_hill_hill"] == pytest.approx(924 * (p * (1 - p)) ** 6)
    assert answer["scale"] == "fargo"


@pytest.mark.parametrize(
    ("line", "W"),
    [
        ("--p 0.6666666666666666 --race 9:5", 0.552),
        ("--p 0.6666666666666666 --race 3:3", 0.790),
        ("--p 0.6666666666666666 --set 3:3 --race 3:1", 0.493),
    ],
)
def test_negotiation_of_p5_8(odds, line, W):
    assert odds(line)["p_win_a"] == pytest.approx(W, abs=0.0005)


def test_ratings_are_on_the_npl_scale_unless_said_otherwise(odds):
    assert odds("30 0 --race 1:1")["p_win_a"] == pytest.approx(2 / 3)
    assert odds("30 0 --race 1:1")["scale"] == "npl"
    assert odds("400 0 --scale elo --race 1:1")["p_win_a"] == pytest.approx(10 / 11)
    assert odds("30 0 --scale 15 --race 1:1")["p_win_a"] == pytest.approx(4 / 5)
    assert odds("30 0 --scale 15 --race 1:1")["scale"] == "15 points"


@pytest.mark.parametrize(
    "line",
    [
        "-20 30 --race 3:3",
        "--race 3:3 -20 30",
        "-20 --race 3:3 30",
        "--race 3:3 -- -20 30",
        "-20.0 +30 --race=3:3",
        "-2e1 3.e1 --race 3:3",
    ],
)
def test_negative_ratings(odds, line):
    assert odds(line) == odds("0 50 --race 3:3")


def test_one_number_is_for_both_players(odds):
    assert odds("--p 0.6 --race 7") == odds("--p 0.6 --race 7:7")
    assert odds("--p 0.6 --ahead 3") == odds("--p 0.6 --ahead 3:3")
    assert odds("--p 0.6 --race 2 --set 3") == odds("--p 0.6 --race 2:2 --set 3:3")


@pytest.mark.parametrize(
    ("line", "meant"),
    [
        ("612 521 --scale npl", "set --scale to fargo"),
        ("612 521", ""),
        ("85 40 --scale fargo", "set --scale to npl"),
        ("105 62", ""),
        ("-20 30", ""),
        ("612 521 --scale fargo", ""),
        ("91 0 --scale fargo", ""),
        ("1800 1500 --scale elo", ""),
        ("612 521 --scale 100", ""),
    ],
)
def test_ratings_that_look_like_those_of_another_scale_are_answered_with_a_warning(
    run, line, meant
):
    result = run("odds", *line.split(), "--race", "7", "--text")
    assert result.exit_code == 0
    assert (result.stderr != "") == (meant != "")
    assert meant in result.stderr


def test_two_ratings_without_a_scale_are_on_the_only_one_that_they_fit_or_refused(run, odds):
    for line, scale in (("612 521", "fargo"), ("105 62", "npl"), ("1712 1540", "elo")):
        assert odds(f"{line} --race 7")["scale"] == scale
    result = run("odds", "190", "140", "--race", "7")
    assert result.exit_code == 2
    assert "A wins a game against B 76% of the time by NPL ratings, 59% by Fargo" in result.stderr


def test_p1_p2_are_echoed_where_the_break_matters(odds):
    answer = odds(" ".join([*BREAKS, "--race 5:5"]))
    assert (answer["p_game_a"], answer["p1"], answer["p2"]) == (None, 0.6, 0.5)
    answer = odds("--p 0.6 --race 5:5")
    assert (answer["p_game_a"], answer["p1"], answer["p2"]) == (0.6, None, None)
    assert answer["scale"] is None


def test_first_break(odds):
    line = "--p1 0.9 --p2 0.9 --race 1:1 --breaks "
    assert odds(line + "winner")["p_win_a"] == 0.9
    assert odds(line + "winner --first-break b")["p_win_a"] == pytest.approx(0.1)
    assert odds(line + "a")["p_win_a"] == 0.9
    assert odds(line + "b")["p_win_a"] == pytest.approx(0.1)
    assert odds(line + "b --first-break a")["p_win_a"] == 0.9


def test_break_carries_across_sets(odds):
    # The loser of a set of one rack breaks the next: sets of 1:1 are racks.
    rest = " --p1 0.7 --p2 0.4 --breaks loser --first-break b"
    sets, racks = odds("--set 1:1 --race 4:3" + rest), odds("--race 4:3" + rest)
    assert sets["p_win_a"] == pytest.approx(racks["p_win_a"], rel=1e-14)
    assert sets["mean_games"] == pytest.approx(racks["mean_games"], rel=1e-14)


def test_score_counts_sets_in_a_match_of_sets(odds):
    W = odds("--p 0.6 --race 3:3")["p_win_a"]
    assert odds("--p 0.6 --set 3:3 --race 2:2 --score 1:1")["p_win_a"] == pytest.approx(W)
    assert odds("--p 0.6 --race 2:2 --score 1:1")["p_win_a"] == pytest.approx(0.6)


def test_win_by(odds):
    # From deuce at 1:1, two in a row before the other.
    deuce = odds("--p 0.6 --race 2:2 --win-by 2 --score 1:1")["p_win_a"]
    assert deuce == pytest.approx(0.36 / 0.52)
    assert deuce == pytest.approx(odds("--p 0.6 --ahead 2:2")["p_win_a"])


@pytest.mark.parametrize("line", ["--p 0.6 --ahead 5:3", "--p 0.6 --set 3:3 --race 3:1"])
def test_hill_hill_and_shutouts_are_null_where_they_mean_nothing(odds, line):
    answer = odds(line)
    assert {answer[key] for key in ("p_hill_hill", "p_shutout_a", "p_shutout_b")} == {None}


def test_a_match_that_never_ends(odds):
    answer = odds("--p1 1 --p2 1 --breaks alternate --ahead 2:2")
    assert answer["p_never_ends"] == 1.0
    assert (answer["p_win_a"], answer["p_win_b"]) == (0.0, 0.0)
    assert {answer[key] for key in ("mean_games", "sd_games", "games_p50", "games_p90")} == {None}


def test_a_match_that_is_over(odds):
    answer = odds("--p 0.6 --race 3:3 --score 3:1")
    assert (answer["p_win_a"], answer["mean_games"], answer["games_p90"]) == (1.0, 0.0, 0)


def test_csv_into_a_pipe(run, odds):
    line = "612 521 --scale fargo --race 7:7"
    head, *rows = csv.reader(run("odds", *line.split()).stdout.splitlines())
    assert head == ["quantity", "value"]
    answer = odds(line)
    assert [key for key, _ in rows] == list(answer)
    for key, text in rows:
        value = answer[key]
        if isinstance(value, float):
            assert text == f"{value:.6f}"
        else:
            assert text == ("" if value is None else str(value))


@pytest.mark.slow
def test_a_person_at_a_terminal_reads_text():
    pty = pytest.importorskip("pty")
    ours, theirs = pty.openpty()
    words = ["odds", "--p1", "1e-300", "--p2", "1e-300", "--breaks", "alternate", "--ahead", "3:3"]
    done = subprocess.run([sys.executable, "-m", "evenbreak", *words], stdout=theirs)
    os.close(theirs)
    text = b""
    try:
        while chunk := os.read(ours, 4096):
            text += chunk
    except OSError:  # how Linux ends a terminal that nobody writes to any more
        pass
    os.close(ours)
    assert done.returncode == 0
    numbers = [line.split()[-1] for line in text.decode().splitlines() if line.strip()]
    assert {"2e+300", "1.39e+300", "4.61e+300"} <= set(numbers)
    assert b"\x1b" not in text


@each_of(
    "line, named",
    [
        ("612 521", "--race"),
        ("612 521 --race 7:7 --ahead 2:2", "--ahead"),
        ("612 --race 7:7", "rating, 612"),
        ("1 2 3 --race 7:7", "1 2 3"),
        ("--race 7:7", "--breaks"),
        ("612 521 --p 0.5 --race 7:7", "given twice"),
        ("--p 0.5 --p1 0.5 --p2 0.5 --breaks winner --race 7:7", "given twice"),
        ("--p 0.5 --scale fargo --race 7:7", "--scale"),
        ("--p1 0.5 --race 7:7", "--p2"),
        ("--p1 0.5 --p2 0.5 --race 7:7", "--breaks"),
        ("--p 0.5 --breaks winner --race 7:7", "--first-break"),
        ("612 521 --first-break b --race 7:7", "--first-break"),
        ("--p 0.5 --ahead 2:2 --win-by 2", "--ahead"),
        ("--p 0.5 --race 2:2 --set 3:3 --win-by 2", "--set"),
        ("six five --race 7:7", "'six'"),
        ("nan 5 --race 7:7", "'nan'"),
        ("7:5 --p 0.6", "match goes with --race 7:5"),
        ("n-ahead_3 --p 0.6", "match goes with --ahead 3:3"),
        ("1e999 5 --race 7:7", "too far apart"),
        ("612 521 --rac 7:7", "--race"),
        ("612,5 521 --race 7", "612.5"),
        ("612 521 --race 7:", "such as 7:5"),
        ("612 521 --race 7 --score 3", "such as 3-0"),
        ("612 521 --race 7_5", "such as 7:5"),
        ("612 521 --race 0:5", "Give 1 to 1000"),
        ("612 521 --race 9999:5", "Give 1 to 1000"),
        ("612 521 --race 7:5 --score -1:0", "from 0 to 1000"),
        ("612 521 --race 7:5 --score 9:0", "9-0"),
        ("--p 1.5 --race 7:5", "'1.5'"),
        ("--p nan --race 7:5", "'nan'"),
        ("--p half --race 7:5", "'half'"),
        ("612 521 --scale golf --race 7:5", "'golf'"),
        ("612 521 --scale 0 --race 7:5", "'0'"),
        ("--p1 0.5 --p2 0.5 --breaks me --race 7:5", "'winner'"),
        ("--p 0.5 --race 7:7 --win-by 0", "win-by"),
        ("--p 0.5 --race 3:3 --win-by 101", "possible scores"),
        ("--p 0.5 --race 30:30 --set 30:30", "possible scores"),
        ("--p 0.5 --race 101 --exact", "possible scores"),
        ("612 521 --race 5 --exact", "--exact"),
    ],
)
def test_wrong_use(refused, line, named):
    assert named in refused("odds", *line.split())


WORDS_OF_A_LINE = (
    "--race --ahead --set --score --win-by --p --p1 --p2 --breaks --first-break --scale --json "
    "--top -h -1 0 0.5 1 2 612 -20 3:3 1:0 2:1 0:0 winner alternate a b npl 1e400 nan : -- -"
)
words = st.sampled_from(WORDS_OF_A_LINE.split()) | st.text(max_size=4)


@given(st.lists(words, max_size=9))
def test_no_words_make_a_traceback(run, line):
    result = run("odds", *line)
    assert result.exit_code in (0, 2)
    assert (result.stdout == "") == (result.exit_code == 2)


@given(
    who=st.sampled_from(["612 521", "-20 30", "--p 0.6", "--p 1", " ".join(BREAKS)]),
    what=st.sampled_from(["--race", "--ahead"]),
    m=st.integers(1, 5),
    n=st.integers(1, 5),
    extra=st.sampled_from(["", "--set 2:2", "--score 0:1", "--win-by 2"]),
)
def test_whatever_is_asked_rightly_is_answered_with_the_same_keys(run, who, what, m, n, extra):
    if what == "--ahead" and extra == "--win-by 2":
        extra = ""
    result = run("odds", *who.split(), what, f"{m}:{n}", *extra.split(), "--json")
    assert result.exit_code == 0
    answer = json.loads(result.stdout)
    assert set(answer) >= KEYS
    total = answer["p_win_a"] + answer["p_win_b"] + answer["p_never_ends"]
    assert total == pytest.approx(1, abs=1e-12)


def test_exact_chances(run):
    answer = json.loads(run("odds", *["--p", "0.6", "--ahead", "2:2", "--exact", "--json"]).stdout)
    assert (answer["p_win_a_exact"], answer["p_win_b_exact"]) == ("9/13", "4/13")
    assert "p_win_a_exact" not in json.loads(
        run("odds", "--p", "0.6", "--race", "2", "--json").stdout
    )


def test_no_numpy_on_the_way():
    heavy = {"numpy", "scipy", "pandas", "networkx", "rich", "json", "importlib.metadata"}
    code = (
        "import sys\nfrom evenbreak.cli import main\n"
        "sys.argv = 'evenbreak odds 612 521 --scale fargo --race 7:7'.split()\n"
        "try: main()\nexcept SystemExit: pass\n"
        f"print(','.join({heavy} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.stdout.splitlines()[-1] == ""


def test_two_names_of_a_list_have_the_chances_of_matchups(run):
    roster = str(DATA / "demo_roster.csv")
    names = ("Keiko Amasuda", "Noor Al-Beyrati")
    odds = json.loads(run("odds", *names, "--from", roster, "--race", "7:5", "--json").stdout)
    assert (odds["player_a"], odds["player_b"]) == names
    listed = run("matchups", roster, "--games", "11..11", "--json").stdout
    for pair in json.loads(listed)["pairs"]:
        if (pair["player_a"], pair["player_b"]) == names:
            race = f"{pair['race_a']}:{pair['race_b']}"
    odds = json.loads(run("odds", *names, "--from", roster, "--race", race, "--json").stdout)
    (found,) = [
        pair
        for pair in json.loads(listed)["pairs"]
        if (pair["player_a"], pair["player_b"]) == names
    ]
    for name in ("p_win_a", "p_game_a", "mean_games", "games_p90"):
        assert odds[name] == pytest.approx(found[name], abs=1e-9)
    fair = run("fair", *names, "--from", roster, "--games", "11..11", "--json").stdout
    best = json.loads(fair)["races"][0]
    assert f"{best['race_a']}:{best['race_b']}" == race


def test_names_stand_where_a_and_b_would(run):
    words = ("Keiko Amasuda", "Noor Al-Beyrati", "--from", str(DATA / "demo_roster.csv"))
    for asked in (
        ("odds", "--race", "7:5"),
        ("fair", "--race-to", "7"),
        ("live", "--race", "7:5", "--racks", "abb", "--comebacks"),
        ("compare", "7:5", "ahead 3:3"),
    ):
        command, *rest = asked
        text = run(command, *words, *rest, "--text", "--verbose").stdout
        assert "Keiko Amasuda" in text
        assert not re.search(r"\bA\b|\bB\b", text)
