"""`evenbreak sandbag pay`: what losing on purpose pays."""

import csv
import json

import pytest


def table(text):
    return list(csv.DictReader(text.splitlines()))


@pytest.fixture
def pay(run):
    def ask(*words):
        result = run("sandbag", "pay", *words, "--json")
        assert result.exit_code == 0, result.stderr
        return json.loads(result.stdout)

    return ask


def test_into_a_pipe_goes_a_row_for_each_number_dumped(run):
    result = run("sandbag", "pay", "--dumped", "6", "--earnest", "5")
    rows = table(result.stdout)
    assert result.exit_code == 0
    assert [row["dumped"] for row in rows] == [str(k) for k in range(7)]
    assert rows[6]["p_first"] == "0.636719"
    assert rows[0]["break_even"] == ""


def test_json_has_the_best_number_and_who_enters_low(pay):
    answer = pay("--dumped", "2", "--earnest", "3")
    assert len(answer["p_win"]) == len(answer["rows"]) == 3
    assert len(answer["p_honest"]) == 5
    assert answer["best"]["dumped"] >= 2
    assert set(answer["enters_low"]) == {"established", "newcomer"}


def test_where_nothing_pays_no_cycle_is_advised(pay):
    answer = pay("--stake", "0", "--dumped", "1", "--earnest", "2")
    assert answer["best"]["dumped"] == 0
    assert not any("cycles" in sentence for sentence in answer["sentences"])


@pytest.mark.slow
def test_charts_side_by_side(pay, run):
    charts = {row["chart"]: row for row in pay("--compare", "--dumped", "3")["charts"]}
    assert set(charts) == {"npl_8", "npl_10", "npl_12", "npl_20"}
    assert charts["npl_8"]["profit"] < charts["npl_20"]["profit"]
    rows = table(run("sandbag", "pay", "--compare", "--dumped", "3").stdout)
    assert list(rows[0]) == list(charts["npl_8"])


def test_the_picture(run, tmp_path):
    path = tmp_path / "pay.svg"
    assert run("sandbag", "pay", "--dumped", "4", "--plot", str(path)).exit_code == 0
    assert "<svg" in path.read_text()


def test_what_pays_at_least_is_of_all_that_can_be_dumped(pay):
    # The table ends long before: with 2 dumped it pays from 25.68.
    answer = pay("--system", "fixed", "--dumped", "2")
    assert answer["rows"][2]["break_even"] > 25.0
    assert any("2.15 times" in sentence for sentence in answer["sentences"])


def test_steps_that_leave_the_ladder(run, pay):
    answer = pay("--system", "step 40", "--dumped", "5")
    assert len(answer["rows"]) == 3
    assert "2 matches" in answer["warnings"][0]
    none = run("sandbag", "pay", "--system", "step 200")
    assert none.exit_code == 2
    assert "smaller steps" in none.stderr


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("--stake", "much"), "'much'"),
        (("--dumped", "0"), "'0'"),
        (("--system", "foo"), "'foo'"),
        (("--chart", "apa_9ball"), "'apa_9ball'"),
        (("--compare", "--chart", "npl_8"), "--chart"),
    ],
)
def test_what_is_wrong_is_refused_by_name(run, words, named):
    result = run("sandbag", "pay", *words)
    assert (result.exit_code, result.stdout) == (2, "")
    assert named in result.stderr
