import json
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.stats import compare, mean_interval, trend, was_it_luck
from places import DATA
from rows import each_of

BEFORE, AFTER = (str(DATA / f"practice_scores{end}.csv") for end in ("", "_after"))
WEEKS = [50, 44, 46, 52, 47, 51, 49, 45, 48, 50]
LATER = [53, 49, 52, 47, 54, 51, 53, 50]


@pytest.fixture
def practice(run):
    def ask(*words, stdin=None):
        result = run("practice", "--json", *words, stdin=stdin)
        assert result.exit_code == 0, result.stderr
        return json.loads(result.stdout)

    return ask


def test_one_list(practice):
    answer = practice(BEFORE, "--confidence", "0.8")
    own, text = mean_interval(WEEKS, 0.8), mean_interval(WEEKS, 0.8, method="normal")
    line = trend(range(10), WEEKS, 0.8)
    wanted = {
        "n": 10,
        "mean": 48.2,
        "sd": own.sd,
        "confidence": 0.8,
        "low": own.low,
        "high": own.high,
        "low_normal": text.low,
        "high_normal": text.high,
        "slope_per_week": pytest.approx(line.slope),
        "slope_low": pytest.approx(line.low),
        "slope_high": pytest.approx(line.high),
        "p_slope": pytest.approx(line.p_value),
    }
    assert {name: answer[name] for name in wanted} == wanted
    assert (round(answer["low_normal"], 1), round(answer["high_normal"], 1)) == (47.2, 49.2)


@pytest.mark.parametrize(
    "text", ["score\n4\n5\n7\n", "date,score\n2024-09-03,4\n2024-09-03,5\n2024-09-03,7\n"]
)
def test_no_trend_without_dates(practice, text):
    answer = practice("-", stdin=text)
    assert (answer["n"], answer["slope_per_week"]) == (3, None)


def test_a_trend_in_points_a_week(practice):
    rows = "".join(f"2024-09-{day:02},{40 + day + day % 2}\n" for day in range(1, 20))
    answer = practice("-", stdin=f"date,score\n{rows}")
    assert answer["slope_per_week"] == pytest.approx(7.0, abs=0.1)
    assert answer["p_slope"] < 1e-6


@pytest.mark.parametrize("text", ["score\n48\n", "score\n48\n48\n48\n"])
def test_scores_without_spread_have_a_mean_only(practice, text):
    answer = practice("-", stdin=text)
    assert (answer["mean"], answer["sd"], answer["low"], answer["low_normal"]) == (
        *(48.0, None, None, None),
    )


def test_one_new_score(practice):
    answer = practice(BEFORE, "--new", "53", "--confidence", "0.8")
    luck = was_it_luck(WEEKS, 53, confidence=0.8)
    assert answer["units"] == luck.t.units
    assert answer["units_normal"] == luck.normal.units
    assert answer["units_cautious"] == luck.cautious.units
    assert (answer["p_as_far"], answer["p_as_high"], answer["p_as_low"]) == luck.t[1:]
    assert answer["p_as_far_normal"] == luck.normal.as_far
    assert answer["p_as_far_cautious"] == luck.cautious.as_far
    assert (answer["p_as_high_by_rank"], answer["p_as_low_by_rank"]) == (1 / 11, 1.0)


def test_a_low_score_and_one_on_the_mean(practice):
    low = practice(BEFORE, "--new", "-3.5")
    assert low["p_as_low"] < 1e-6 < 0.5 < low["p_as_high"]
    assert practice(BEFORE, "--new", "48.2")["units"] == 0.0


def test_two_lists(practice):
    answer = practice(BEFORE, "--versus", AFTER, "--confidence", "0.9")
    found = compare(WEEKS, LATER, confidence=0.9)
    assert len(answer["warnings"]) == 1  # there are few scores after
    assert answer["p_welch"] == found.welch.p_value
    assert answer["p_student"] == found.student.p_value
    assert answer["p_anova"] == found.anova.p_value
    assert answer["p_variances"] == found.variances.p_value
    assert answer["p_mann_whitney"] == found.mann_whitney.p_value
    assert answer["p_chi_squared"] == found.chi_squared.p_value
    assert (answer["difference"], answer["low"], answer["high"]) == (
        found.difference,
        found.low,
        found.high,
    )
    assert (
        answer["g"],
        answer["g_low"],
        answer["g_high"],
        answer["p_after_higher"],
    ) == found.effect
    assert (answer["n_before"], answer["mean_after"]) == (10, 51.125)


def test_two_lists_without_spread(practice, tmp_path):
    other = tmp_path / "other.csv"
    other.write_text("score\n5\n5\n")
    answer = practice("-", "--versus", str(other), stdin="score\n4\n4\n4\n")
    assert (answer["difference"], answer["p_welch"], answer["low"], answer["g"]) == (
        1.0,
        None,
        None,
        None,
    )
    assert answer["p_after_higher"] == 1.0


def test_csv_into_a_pipe_with_the_verdict_beside_it(run):
    result = run("practice", BEFORE, "--versus", AFTER)
    lines = dict(line.split(",") for line in result.stdout.splitlines())
    assert lines.pop("quantity") == "value"
    assert lines["p_welch"] == f"{compare(WEEKS, LATER).welch.p_value:.6f}"
    assert all(math.isfinite(float(value)) for value in lines.values())
    assert result.stderr.count("Warning: ") == 1


@pytest.mark.slow_after(3)
@pytest.mark.parametrize(
    "words",
    [[BEFORE], [BEFORE, "--new", "53"], [BEFORE, "--versus", AFTER], ["-"], ["-", "--new", "3"]],
)
@pytest.mark.parametrize("end", [".png", ".svg"])
def test_plot(run, tmp_path, words, end):
    picture = tmp_path / f"scores{end}"
    result = run("practice", *words, "--plot", str(picture), stdin="score\n3\n4\n4\n")
    assert result.exit_code == 0
    assert f"Wrote {picture}\n" in result.stderr
    assert picture.read_bytes()[:4] in (b"\x89PNG", b"<?xm")


@pytest.mark.parametrize("text", ["score\n48\n", "date,score\n2024-09-03,48\n2024-09-03,48\n"])
def test_plot_of_nearly_nothing(run, tmp_path, text):
    picture = tmp_path / "scores.png"
    assert run("practice", "-", "--plot", str(picture), stdin=text).exit_code == 0
    assert picture.exists()


@each_of(
    "line, code, wrong",
    [
        ("", 2, "SCORES.csv"),
        ("- --new 53 --versus -", 2, "--new and --versus"),
        ("- --versus -", 2, "standard input"),
        ("- --new much", 2, "'much' isn't a score"),
        ("- --new 48,5", 2, "48.5"),
        ("- --new nan", 2, "'nan' isn't a score"),
        ("- --new 1e99", 2, "'1e99' isn't a score"),
        ("- --confidence 1", 2, "'1' isn't a confidence"),
        ("- --confidence 95", 2, "'95' isn't a confidence"),
        ("- --plot scores.pdf", 2, "scores.pdf"),
        ("no.csv", 3, "no.csv: there's no such file"),
        ("- --new 5", 3, "stdin: --new needs"),
        (f"- --versus {BEFORE}", 3, "stdin: has 1 score"),
        (f"{BEFORE} --versus -", 3, "--new"),
    ],
)
def test_wrong_use_is_named(run, line, code, wrong):
    result = run("practice", *line.split(), stdin="score\n48\n")
    assert (result.exit_code, result.stdout) == (code, "")
    assert wrong in " ".join(result.stderr.split())


def test_all_problems_of_a_file(run):
    result = run("practice", "-", stdin="date,score\nMonday,x\n2024-09-03,\n")
    assert (result.exit_code, result.stdout) == (3, "")
    assert result.stderr.count("Error: stdin:") == 3


words = st.sampled_from(["-", "--new", "--versus", "--confidence", "--json", "3", "0.8", BEFORE])
tables = st.text(alphabet="score,date\n0123456789.-e", max_size=40) | st.lists(
    st.floats().map(str), max_size=5
).map(lambda cells: "\n".join(["score", *cells]))


@given(st.lists(words | st.text(max_size=3), max_size=6), tables)
def test_no_words_make_a_traceback(run, line, text):
    assert run("practice", *line, stdin=text).exit_code in (0, 2, 3)


TWO_DRILLS = "drill,score\nLine,4\nL drill,50\nLine,6\nl-drill,54\n"


def test_the_scores_of_two_drills_are_not_averaged(run, practice):
    refused = run("practice", "-", stdin=TWO_DRILLS)
    assert refused.exit_code != 0
    assert "'Line', 'L drill'" in refused.stderr
    assert practice("-", "--drill", "line", stdin=TWO_DRILLS)["mean"] == 5
    assert practice("-", "--drill", "L drill", stdin=TWO_DRILLS)["mean"] == 52


@pytest.mark.parametrize(("text", "named"), [
    (TWO_DRILLS, "'Q'"),
    ("score\n4\n6\n", "--drill"),
    ("drill,score\nQ,4\n,6\n", ":3: drill"),
])  # fmt: skip
def test_a_drill_that_the_file_does_not_settle_is_refused(run, text, named):
    refused = run("practice", "-", "--drill", "Q", stdin=text)
    assert refused.exit_code != 0
    assert named in refused.stderr


def test_one_drill_needs_no_option(practice):
    assert practice("-", stdin="drill,score\nLine,4\nLine,6\n")["mean"] == 5


SHOTS = str(DATA / "practice_shots.csv")


def test_a_log_of_shots_says_what_to_practice_and_whether_it_got_better(practice):
    told = practice(SHOTS)
    assert [row["shot"] for row in told["shots"]][:2] == ["jump", "bank"]
    assert told["since"] == "2024-10-01"
    assert 1.0 < told["odds_ratio_low"] < told["odds_ratio"] < told["odds_ratio_high"]
    assert f"made {told['made_before']:.0%}, and since then {told['made_after']:.0%}" in " ".join(
        told["sentences"]
    )
    jump = told["shots"][0]
    assert 1 / 8 < jump["chance"] < 0.5  # drawn toward the others
    assert jump["share_before"] is None


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        ("shot,made,tried\ncut,6,10\nbank,2,10", "Give every row a date"),
        ("made,tried\n6,10", "Give every row a date"),
        ("date,made,tried\n2025-01-01,6,10\n2025-01-02,6,10", "No sign of a change"),
        ("date,shot,made,tried\n2025-01-01,a,6,10\n2025-01-02,b,6,10", "both halves"),
        ("shot,made,tried\na,50,100\nb,50,100\nc,52,100", "too close to tell"),
        ("date,made,tried\n2025-01-01,9,20\n2025-02-02,1,20", "You got worse"),
        ("date,made,tried\n2025-01-01,9,20\n2025-02-02,20,20", "by more than 4.17"),
        ("date,made,tried\n2025-01-01,20,20\n2025-02-02,9,20", "by less than 0.2"),
        ("date,made,tried\n2025-01-01,20,20\n2025-02-02,20,20", "No sign of a change"),
    ],
)
def test_what_a_log_of_shots_cannot_show(practice, rows, words):
    assert words in " ".join(practice("-", stdin=rows)["sentences"])


@pytest.mark.parametrize("title", ["Result", "Made?", "Made it", "Points"])
@pytest.mark.parametrize(
    ("made", "missed"),
    [
        ("make", "miss"),
        ("Made", "MISSED"),
        ("yes", "no"),
        ("1", "0"),
        ("x", "-"),
        ("TRUE", "FALSE"),
    ],
)
def test_a_row_a_try_is_read_as_counts(practice, title, made, missed):
    counts = {("2025-01-03", "cut"): 7, ("2025-01-03", "bank"): 2, ("2025-02-03", "cut"): 9}
    tries = [
        f"{day},{shot},{made if k < n else missed}"
        for (day, shot), n in counts.items()
        for k in range(10)
    ]
    rows = [f"{day},{shot},{n},10" for (day, shot), n in counts.items()]
    one = practice("-", stdin="\n".join([f"Date,Shot,{title}", *tries]))
    assert one == practice("-", stdin="\n".join(["date,shot,made,tried", *rows]))


def test_numbers_beside_a_word_are_scores(run):
    refused = run("practice", "-", stdin="date,score\n2025-01-03,48\n2025-01-04,miss")
    assert "Write a score such as 48" in refused.stderr


@pytest.mark.parametrize(
    ("rows", "more", "words"),
    [
        ("shot,made,tried\ncut,11,10", (), "stdin:2: 11 made out of 10"),
        ("shot,made,tried\ncut,1,0", (), "tried"),
        ("shot,made\ncut,6", (), "no column 'tried'"),
        ("date,shot,result\n2025-01-01,cut,x\n2025-01-02,cut,yes", (), "made and tried"),
        ("date,shot,result" + "\n2025-01-01,cut,good" * 20, (), "columns shot, made and tried"),
        ("date,shot,result\n2025-01-01,cut,", (), "score is empty"),
        ("shot,made,tried\ncut,1,2", ("--new", "5"), "--new is for scores"),
        ("shot,made,tried\ncut,1,2", ("--drill", "x"), "Leave --drill out"),
    ],
)
def test_a_wrong_log_of_shots_is_refused(run, rows, more, words):
    result = run("practice", "-", *more, stdin=rows)
    assert result.exit_code in (2, 3)
    assert words in result.stderr
