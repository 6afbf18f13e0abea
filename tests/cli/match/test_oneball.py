import pytest
from hypothesis import given
from hypothesis import strategies as st

from rows import each_of

COLUMNS = [
    "shot",
    "kind",
    "p1",
    "p2",
    "p_win_infinite",
    "p_win_two_shots",
    "critical_p2",
    "behind",
    "turning_p2",
]


@pytest.fixture
def oneball(ask):
    def answer(line):
        told = ask("oneball", *line.split())
        assert set(told) == {"look_ahead", "shots"}
        for shot in told["shots"]:
            assert list(shot) == COLUMNS
        return told["shots"]

    return answer


def test_the_paradox_of_p5_22(oneball):
    best, other = oneball("--shot 0.4:0.8 --shot 0.3:0.3")
    assert (best["shot"], best["kind"], other["shot"], other["kind"]) == (
        2,
        "safety",
        1,
        "sell-out",
    )
    assert best["p_win_infinite"] == pytest.approx(10 / 17)
    assert other["p_win_two_shots"] == pytest.approx(0.46)
    assert other["critical_p2"] == pytest.approx(2 / 3)
    assert other["behind"] == pytest.approx(10 / 17 - 5 / 11)
    # With this p2 the first shot would win 10/17 too: 0.4 / (0.4 + 0.6 p2) = 10/17.
    assert other["turning_p2"] == pytest.approx(7 / 15)


def test_look_ahead_may_change_the_choice(oneball):
    line = "--shot 0.1:0.05 --shot 0.5:0.8"
    assert [shot["shot"] for shot in oneball(line)] == [1, 2]
    assert [shot["shot"] for shot in oneball(f"{line} --look-ahead two")] == [2, 1]


def test_later_shots_have_chances_of_their_own(ask):
    told = ask("oneball", *["--shot", "0.4:0.8:0.5:0.2", "--shot", "0.3:0.3"])
    assert told["look_ahead"] == "all shots"
    best, other = told["shots"]
    assert (best["shot"], best["later"], other["shot"], other["later"]) == (
        2,
        "",
        1,
        "0.5 0.2",
    )
    # By hand: 0.4 + 0.6 0.2 (0.5 + 0.5 0.8 / 2), and 0.3 + 0.7 0.7 / 2.
    assert other["p_win_all_shots"] == pytest.approx(0.484)
    assert best["p_win_all_shots"] == best["p_win_two_shots"] == pytest.approx(0.545)
    # Even if a miss leaves p2 with 0.4 + 0.6 (1 - p2) 0.7 = 1/2.
    assert other["critical_p2"] == pytest.approx(1 - 0.1 / 0.42)
    first = ask(
        "oneball", *["--shot", "0.4:0.8:0.5:0.2", "--shot", "0.3:0.3", "--look-ahead", "infinite"]
    )
    assert first["look_ahead"] == "infinite"
    assert first["shots"][0]["behind"] == 0.0


def test_no_critical_p2_above_one_half(oneball):
    assert oneball("--shot 0.6:0.9")[0]["critical_p2"] is None
    assert oneball("--shot 0.5:0.9")[0]["critical_p2"] == 1.0


def test_csv_into_a_pipe(run):
    assert run("oneball", "--shot", "0.4:0.8", "--shot", "1:0").stdout.splitlines() == [
        ",".join(COLUMNS),
        "2,two-way shot,1.000000,0.000000,1.000000,1.000000,,0.000000,",
        "1,sell-out,0.400000,0.800000,0.454545,0.460000,0.666667,0.545455,0.000000",
    ]


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["png", "svg"])
def test_plot(run, tmp_path, kind):
    path = tmp_path / f"shots.{kind}"
    result = run("oneball", "--shot", "0.4:0.8", "--shot", "0.3:0.3", "--plot", str(path), "--text")
    assert (result.exit_code, result.stderr) == (0, f"Wrote {path}\n")
    assert path.read_bytes()[:4] == {"png": b"\x89PNG", "svg": b"<?xm"}[kind]


@each_of(
    "line, named",
    [
        ("0.4", "such as 0.3:0.3"),
        ("--shot 1.4:0.8", "'1.4'"),
        ("0.4 nan", "'nan'"),
        ("-0.1 0.5", "'--shot': '-0.1'"),
        ("0.1 -5e-1 --json", "'--shot': '-5e-1'"),
        ("--shot 0.1:0.5 --oder 0.3:0.3", "--oder"),
        ("--shot 0.4:0.8 --shot 0.3", "such as 0.3:0.3"),
        ("--shot 0.4:0.8 --shot 0.3:1.3", "from 0 to 1"),
        ("--shot 0.4:0.8:1.5", "1.5"),
        ("--shot 0.4:0.8:0.5 --plot shots.png", "--look-ahead"),
        ("--shot 0.4:0.8 --look-ahead three", "'--look-ahead'"),
        ("--shot 0.4:0.8 --plot shots.gif", ".png or .svg"),
    ],
)
def test_wrong_use(refused, line, named):
    assert named in refused("oneball", *line.split())


WORDS_OF_A_LINE = "--shot --look-ahead two --json 0.5 -0.5 0 1 0.3:0.3 0:0 :"
words = st.sampled_from(WORDS_OF_A_LINE.split()) | st.text(max_size=4)


@given(st.lists(words, max_size=8))
def test_no_words_make_a_traceback(run, line):
    assert run("oneball", *line).exit_code in (0, 2)


def test_chances_without_their_option_are_taken_with_a_note(run):
    told, now = (
        run("oneball", "0.4", "0.8", "--or", "0.3:0.3"),
        run("oneball", "--shot", "0.4:0.8", "--shot", "0.3:0.3"),
    )
    assert told.stdout == now.stdout
    assert told.stderr.startswith(
        "Note: --or is now called --shot.\nNote: write --shot 0.4:0.8 in place of 0.4 0.8.\n"
    )
