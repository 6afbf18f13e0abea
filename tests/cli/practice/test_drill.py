import csv
import io
import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.games import Drill
from evenbreak.practice import drill_statistics
from evenbreak.practice.drill_log import MOST_LEVELS as MOST_OF_A_LOG
from evenbreak.questions.practice import MOST_LEVELS
from places import DATA
from rows import each_of

LOG_FILE = DATA / "drill_log.csv"
COLUMNS = ["level", "p_success", "long_run", "gain", "lift"]
LOG_COLUMNS = [
    *("level", "attempts", "successes", "p_success", "p_low", "p_high", "p_model", "visited"),
    *("expected", "long_run", "gain", "lift", "lift_low", "lift_high", "p_best"),
]
MODEL_KEYS = {"drill_levels", "mean", "median", "mode", "sd", "practice_next", "period"}
LOG_KEYS = {
    *("drill_levels", "mean", "median", "mode", "sd", "mean_low", "mean_high", "mean_so_far"),
    *("practice_next", "difference", "memory", "model_test", "model", "furthest_off_model"),
    *("attempts", "sessions", "against_the_rule", "replicas", "seed"),
}


@pytest.fixture
def drill(run):
    def ask(*words, stdin=None):
        result = run("drill", "--json", *words, stdin=stdin)
        assert result.exit_code == 0, result.stderr
        return json.loads(result.stdout)

    return ask


def test_the_model_of_table_5_5(drill):
    answer = drill("--p", "0.8")
    assert set(answer) >= MODEL_KEYS
    assert [list(row) for row in answer["drill_levels"]] == [COLUMNS] * 9
    assert round(answer["mean"], 3) == 4.354
    assert (answer["median"], answer["mode"], round(answer["sd"], 3)) == (4, 4, 1.526)
    assert (answer["practice_next"], answer["period"]) == (4, 1)
    statistics = drill_statistics(Drill.progressive(0.8))
    for name, values in (
        ("p_success", statistics.drill.success),
        ("long_run", statistics.distribution.probability),
        ("gain", statistics.gain),
        ("lift", statistics.lift),
    ):
        assert [row[name] for row in answer["drill_levels"]] == list(values)


def test_the_8_ball_drill(drill):
    answer = drill("--p", "0.8", "--game", "8-ball")
    chances = [0.8**level for level in range(1, 8)]
    assert [row["p_success"] for row in answer["drill_levels"]] == pytest.approx(chances, rel=1e-14)
    assert len(drill("--p", "0.8", "--game", "8-ball", "--levels", "3")["drill_levels"]) == 3
    assert drill("--p", "0.8", "--game", "9-ball") == drill("--p", "0.8")


def test_levels_and_chances_of_ones_own(drill):
    assert len(drill("--p", "0.8", "--levels", "4")["drill_levels"]) == 4
    answer = drill("--success", "0.5, .5")
    assert [row["long_run"] for row in answer["drill_levels"]] == [0.5, 0.5]
    assert [row["gain"] for row in answer["drill_levels"]] == [0.5, 0.5]


def test_a_gain_without_bound_is_null(drill, run):
    assert drill("--success", "0.5,0,1")["drill_levels"][1]["gain"] is None
    row = run("drill", "--success", "0.5,0,1").stdout.splitlines()[2].split(",")
    assert (row[0], row[3]) == ("2", "")


def test_a_drill_that_goes_to_and_fro_has_period_2(run, drill):
    # With 0.05 at level 2 the limit has 1/1.95 there in place of 1/2.
    line = ("--p", "0", "--levels", "2")
    assert run("drill", *line).stdout.splitlines()[1:] == [
        "1,1.000000,0.500000,0.250000,0.000000",
        "2,0.000000,0.500000,0.250000,0.012821",
    ]
    answer = drill(*line)
    assert answer["period"] == 2
    assert len(answer["sentences"]) == len(drill("--p", "0.5", "--levels", "2")["sentences"]) + 1


def test_a_giant_gain_keeps_the_table_narrow(run):
    shown = run("drill", "--success", "1e-300,1,0.5", "--text", "--verbose").stdout
    assert "5.56e+299" in shown
    assert max(map(len, shown.splitlines())) < 80


def test_a_log(drill):
    answer = drill("--log", str(LOG_FILE))
    assert set(answer) >= LOG_KEYS
    assert [list(row) for row in answer["drill_levels"]] == [LOG_COLUMNS] * 9
    assert (answer["attempts"], answer["sessions"], answer["against_the_rule"]) == (537, 12, 0)
    assert sum(row["attempts"] for row in answer["drill_levels"]) == 537
    assert answer["practice_next"] == answer["furthest_off_model"] == 5
    assert answer["model_test"]["p_value"] < 0.01 < 0.05 < answer["memory"]["p_value"]
    assert answer["difference"]["p_value"] > 0.05
    assert answer["model"]["level_1_attempts"] == 14
    lines = LOG_FILE.read_text(encoding="utf-8").splitlines()
    level, success = zip(
        *((int(row["level"]), row["success"] == "yes") for row in csv.DictReader(lines)),
        strict=True,
    )
    made = sum(success[k] for k in range(537) if level[k] == 5)
    assert answer["drill_levels"][4]["p_success"] == made / level.count(5)


def test_csv_of_a_log_into_a_pipe(run, drill):
    rows = list(csv.reader(io.StringIO(run("drill", "--log", str(LOG_FILE)).stdout)))
    assert rows[0] == LOG_COLUMNS
    for row, wanted in zip(rows[1:], drill("--log", str(LOG_FILE))["drill_levels"], strict=True):
        for cell, value in zip(row, wanted.values(), strict=True):
            assert float(cell) == pytest.approx(value, abs=5e-7)


def test_the_seed_decides(run):
    line = ("drill", "--log", str(LOG_FILE), "--json")
    assert run(*line).stdout == run(*line, "--seed", "1").stdout
    assert run(*line).stdout != run(*line, "--seed", "2").stdout


def test_the_number_of_levels_changes_the_answer(drill):
    assert len(drill("--log", str(LOG_FILE), "--levels", "10")["drill_levels"]) == 10


def test_levels_nobody_tried_have_no_chance(run, drill):
    log = "level,success\n1,yes\n2,no\n1,no\n1,yes\n2,no\n"
    rows = run("drill", "--log", "-", "--levels", "3", stdin=log).stdout.splitlines()
    assert rows[3].startswith("3,0,0,,0.000000,1.000000,")
    assert drill("--log", "-", "--levels", "3", stdin=log)["drill_levels"][2]["p_success"] is None


def test_level_1_alone_has_neither_model_nor_tests(drill):
    log = "level,success\n1,no\n1,no\n"
    answer = drill("--log", "-", stdin=log)
    assert [answer[key] for key in ("model", "model_test", "memory", "practice_next")] == [None] * 4
    assert drill("--log", "-", "--levels", "5", stdin=log)["practice_next"] == 1


def test_a_step_against_the_rule_is_warned_of(run):
    result = run("drill", "--log", "-", "--json", stdin="level,made\n1,yes\n5,no\n4,no\n")
    assert "Warning: " in result.stderr
    assert ":3: level 5 follows" in result.stderr
    assert json.loads(result.stdout)["against_the_rule"] == 1


def test_bad_data(run):
    result = run("drill", "--log", "-", stdin="level,success\n1,perhaps\n0,no\n")
    assert (result.exit_code, result.stdout) == (3, "")
    assert len(result.stderr.splitlines()) == 2


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("name", ["drill.png", "drill.svg"])
@pytest.mark.parametrize("words", [("--p", "0.8"), ("--log", str(LOG_FILE))])
def test_a_picture(run, tmp_path, words, name):
    result = run("drill", *words, "--plot", str(tmp_path / name))
    assert result.exit_code == 0
    assert (tmp_path / name).read_bytes()[:5] in (b"\x89PNG\r", b"<?xml")


@each_of(
    "line, wrong",
    [
        ("", "--p, --success and --log"),
        ("--p 0.5 --log x.csv", "--p, --success and --log"),
        ("--p 2", "'2'"),
        ("--success 0.5,2", "'0.5,2'"),
        ("--success ,", "','"),
        ("--success " + ",".join(["1"] * 101), "100"),
        ("--success 0.5,0.4 --levels 3", "--levels"),
        ("--success 0.5 --game 8-ball", "--game"),
        ("--p 0.5 --game 8-ball --levels 8", "--levels"),
        ("--p 0.5 --levels 0", "'0'"),
        ("--p 0.5 --levels 101", "'101'"),
        ("--p 0.5 --seed 3", "--seed"),
        ("--p 0.5 --plot x.pdf", "x.pdf"),
    ],
)
def test_wrong_use_is_named(run, line, wrong):
    result = run("drill", *line.split())
    assert (result.exit_code, result.stdout) == (2, "")
    assert wrong in " ".join(result.stderr.split())


def test_command_and_log_have_the_same_most_levels():
    assert MOST_LEVELS == MOST_OF_A_LOG


WORDS_OF_A_LINE = "--p --success --levels --seed --json 0 1 0.5 0.2,0.9 1,0,1 3 -2 nan"
words = st.sampled_from(WORDS_OF_A_LINE.split()) | st.text(max_size=4)


@given(st.lists(words, max_size=6))
def test_no_words_make_a_traceback(run, line):
    assert run("drill", *line).exit_code in (0, 2)


attempts = st.lists(st.tuples(st.integers(1, 4), st.sampled_from(["yes", "no"])), min_size=1)


@given(attempts)
def test_any_log_has_an_answer(run, rows):
    text = "level,success\n" + "".join(f"{level},{word}\n" for level, word in rows[:12])
    result = run("drill", "--log", "-", "--json", stdin=text)
    assert result.exit_code == 0
    answer = json.loads(result.stdout)
    sure = sum(row["p_best"] for row in answer["drill_levels"])
    assert sure == pytest.approx(0 if answer["practice_next"] is None else 1)


def test_drill_option_is_for_logs(run):
    refused = run("drill", "--p", "0.8", "--drill", "Line")
    assert refused.exit_code == 2
    assert "--drill" in refused.stderr
