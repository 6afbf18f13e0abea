import json

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.files.charts import read_chart
from evenbreak.handicaps import RaceLimits, chart, design, measure_chart
from rows import each_of
from tiers import examples

NPL_10 = "--games 7..9 --least 1:2 --beside npl_10"


@pytest.fixture
def ask(run):
    def asked(line):
        result = run("chart", "design", "--json", *line.split())
        assert (result.exit_code, result.stderr) == (0, "")
        return json.loads(result.stdout)

    return asked


def rows_of(answer):
    names = ("difference_from", "difference_to", "stronger_needs", "weaker_needs")
    return [tuple(row[name] for name in names) for row in answer["rows"]]


def test_a_design_beside_a_printed_chart(ask):
    answer = ask(NPL_10)
    limits = RaceLimits((7, 9), weaker_least=2)
    assert rows_of(answer) == [tuple(row) for row in design("npl", limits, up_to=59).rows]
    (beside,) = answer["beside"]
    theirs = measure_chart(chart("npl_10"), "npl", up_to=59)
    assert beside["mean_unfairness"] == theirs.mean_unfairness > answer["mean_unfairness"]
    assert beside["other_races"] == [
        {"difference_from": 0, "difference_to": 5, "design": "4:4", "beside": "5:5"},
        {"difference_from": 46, "difference_to": 46, "design": "6:2", "beside": "7:3"},
    ]


@pytest.mark.slow_after(7)
@pytest.mark.parametrize(
    ("line", "scale", "limits", "wishes"),
    [
        ("--games 5..9 --scale fargo --tilt 0", "fargo", RaceLimits((5, 9), 2, 2), {"tilt": 0.0}),
        ("--games 5..9 --target 0.6", "npl", RaceLimits((5, 9), 2, 2), {"target": 0.6}),
        ("--games 5..19 --most-rows 99", "npl", RaceLimits((5, 19), 2, 2), {"rows": None}),
        ("--games 5..9 --most-rows 3", "npl", RaceLimits((5, 9), 2, 2), {"rows": 3}),
        ("--games 5..9 --up-to 30", "npl", RaceLimits((5, 9), 2, 2), {"up_to": 30}),
        ("--games 5..9 --least 4:3", "npl", RaceLimits((5, 9), 4, 3), {}),
        ("--games 5..9 --games-p90 8", "npl", RaceLimits((5, 9), 2, 2, games_p90=8), {}),
    ],
)
def test_every_option_reaches_the_design(ask, line, scale, limits, wishes):
    made = design(scale, limits, **{"rows": 12, "spread": 2, **wishes})
    assert rows_of(ask(line)) == [tuple(row) for row in made.rows]


@pytest.mark.parametrize("line", ["--games 5..15 --scale fargo --tilt 0", "--games 17..41"])
def test_a_chart_to_print_is_short_and_its_races_are_alike(ask, line):
    answer = ask(line)
    longest = [row["stronger_needs"] + row["weaker_needs"] - 1 for row in answer["rows"]]
    assert len(longest) <= 12
    assert max(longest) - min(longest) <= 2


def test_the_price_of_each_wish(ask):
    this, rows, *shorter = ask("--games 5..15")["prices"]
    assert this["rows"] <= 12 < rows["rows"]
    assert rows["mean_unfairness"] < this["mean_unfairness"]
    unfair = [this["mean_unfairness"], *(one["mean_unfairness"] for one in shorter)]
    assert unfair == sorted(unfair)
    assert [one["games_p90"] for one in shorter] == [11, 9, 7]


def test_what_goes_into_a_pipe_is_a_chart(run, tmp_path):
    result = run("chart", "design", *NPL_10.split())
    path = tmp_path / "ours.csv"
    path.write_text(result.stdout, encoding="utf-8")
    assert read_chart(path).rows == design("npl", RaceLimits((7, 9), weaker_least=2), up_to=59).rows
    assert "npl_10" in result.stderr


def test_a_chart_beside_with_the_same_races_has_no_others(run, ask, tmp_path):
    path = tmp_path / "ours.csv"
    path.write_text(run("chart", "design", *NPL_10.split()).stdout, encoding="utf-8")
    answer = ask(f"{' '.join(NPL_10.split()[:4])} --beside {path} --up-to 59")
    assert answer["beside"][0]["chart"] == "ours"
    assert answer["beside"][0]["other_races"] == []


@each_of(
    "line, wrong",
    [
        ("", "--games"),
        ("--games 7", "'7'"),
        ("--games 7..9 --least 2:", "'2:'"),
        ("--games 7..9 --beside apa_8ball", "--beside"),
        ("--games 7..9 --most-rows 0", "'0'"),
        ("--games 7..9 --scale odd", "'odd'"),
        ("--games 7..9 --tilt 2", "'2'"),
        ("--games 7..9 --games-p90 3", "--games-p90 is 3"),
        ("--games 900..1000", "Narrow --games, raise --least, or lower --up-to"),
        (
            "--games 97..99 --most-rows 99 --up-to 3000",
            "Narrow --games, lower --most-rows or --up-to",
        ),
        ("--games 1..2 --least 5:5", "--games is 1..2"),
    ],
)
def test_wrong_use_is_named(run, line, wrong):
    result = run("chart", "design", *line.split())
    assert (result.exit_code, result.stdout) == (2, "")
    assert wrong in " ".join(result.stderr.split())


WORDS = "--games 5..7 9..5 --least 2:2 --tilt 0 1 --target 0.6 --up-to 30"
words = st.sampled_from(WORDS.split()) | st.text(max_size=4)


@settings(max_examples=examples(50), deadline=None)
@given(st.lists(words, max_size=8))
def test_no_words_make_a_traceback(run, line):
    result = run("chart", "design", *line)
    assert result.exit_code in (0, 1, 2, 3)
