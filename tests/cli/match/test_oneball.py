import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.cli.match.oneball import advice
from evenbreak.practice import Shot, compare_shots

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
def oneball(run):
    def ask(line):
        result = run("oneball", "--json", *line.split())
        assert (result.exit_code, result.stderr) == (0, "")
        answer = json.loads(result.stdout)
        assert list(answer) == ["look_ahead", "shots", "schema_version"]
        for shot in answer["shots"]:
            assert list(shot) == COLUMNS
        return answer["shots"]

    return ask


def told(*shots, look_ahead="infinite"):
    """Return the advice on shots given as pairs (p1, p2)."""
    named = [Shot(str(number), *chances) for number, chances in enumerate(shots, start=1)]
    other = {"infinite": "two shots", "two shots": "infinite"}[look_ahead]
    return advice(
        compare_shots(named, look_ahead=look_ahead), compare_shots(named, look_ahead=other)
    )


def test_the_paradox_of_p5_22(oneball):
    best, other = oneball("0.4 0.8 --or 0.3:0.3")
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
    line = "0.1 0.05 --or 0.5:0.8"
    assert [shot["shot"] for shot in oneball(line)] == [1, 2]
    assert [shot["shot"] for shot in oneball(f"{line} --look-ahead two")] == [2, 1]
    assert told((0.1, 0.05), (0.5, 0.8)).endswith("\nThe other look-ahead prefers shot 2.")
    assert told((0.1, 0.05), (0.5, 0.8), look_ahead="two shots").endswith(" prefers shot 1.")


def test_no_critical_p2_above_one_half(oneball):
    assert oneball("0.6 0.9")[0]["critical_p2"] is None
    assert oneball("0.5 0.9")[0]["critical_p2"] == 1.0


def test_csv_into_a_pipe(run):
    assert run("oneball", "0.4", "0.8", "--or", "1:0").stdout.splitlines() == [
        ",".join(COLUMNS),
        "2,two-way shot,1.000000,0.000000,1.000000,1.000000,,0.000000,",
        "1,sell-out,0.400000,0.800000,0.454545,0.460000,0.666667,0.545455,0.000000",
    ]


@pytest.mark.parametrize(
    ("shots", "words"),
    [
        ([(0.4, 0.8)], "You would be the favourite if a miss leaves less than 0.6667."),
        ([(0.4, 0.2)], "You are the favourite if a miss leaves less than 0.6667."),
        ([(0.6, 1)], "You are the favourite, whatever a miss leaves."),
        ([(0.5, 1)], "The game is even; a little less left makes you the favourite."),
        ([(0, 0)], "Nobody ever makes a ball: nobody wins."),
        ([(0, 0.5)], "You are not the favourite, whatever a miss leaves."),
        ([(0.5, 0.5), (0.4, 1 / 3), (0.5, 0.5)], "Shots 1, 2 and 3 are equally good."),
        ([(0.5, 0.5), (0.2, 0.2), (0.5, 0.5)], "Shots 1 and 3 are equally good."),
        (
            [(0.9, 1), (0.2, 0.2)],
            "Take shot 1: it wins 0.3444 more than shot 2, whatever it leaves.",
        ),
    ],
)
def test_advice(shots, words):
    assert told(*shots) == words


def test_a_terminal_of_80_columns_is_wide_enough(run, monkeypatch):
    for module in ("output", "oneball"):
        monkeypatch.setattr(f"evenbreak.cli.{module}.to_terminal", lambda: True)
    lines = run("oneball", "0.1", "0.05", "--or", "0.55:0.85").stdout.splitlines()
    assert max(map(len, lines)) <= 80
    assert lines[3].split()[:2] == ["you", "miss"]
    assert lines[4].split()[:4] == ["shot", "kind", "make", "leaves"]


@pytest.mark.parametrize("kind", ["png", "svg"])
def test_plot(run, tmp_path, kind):
    path = tmp_path / f"shots.{kind}"
    result = run("oneball", "0.4", "0.8", "--or", "0.3:0.3", "--plot", str(path))
    assert result.exit_code == 0
    assert result.stdout.startswith("shot,kind,")
    assert result.stderr == f"Wrote {path}\n"
    assert path.read_bytes()[:4] == {"png": b"\x89PNG", "svg": b"<?xm"}[kind]


@pytest.mark.parametrize(
    ("line", "remedy"),
    [
        ("0.4", "Missing argument 'P2'"),
        ("1.4 0.8", "'1.4' is not a probability; give a number from 0 to 1"),
        ("0.4 nan", "'nan' is not a probability"),
        ("-0.1 0.5", "'P1': '-0.1' is not a probability; give a number from 0 to 1"),
        ("0.1 -5e-1 --json", "'P2': '-5e-1' is not a probability"),
        ("0.1 0.5 --oder 0.3:0.3", "No such option '--oder'"),
        ("0.4 0.8 --or 0.3", "such as 0.3:0.3"),
        ("0.4 0.8 --or 0.3:1.3", "such as 0.3:0.3"),
        ("0.4 0.8 --or 0.3:0.3:0.3", "such as 0.3:0.3"),
        ("0.4 0.8 --look-ahead three", "'infinite', 'two'"),
        ("0.4 0.8 --plot shots.gif", ".png or .svg"),
    ],
)
def test_wrong_use_says_how_to_mend_it(run, line, remedy):
    result = run("oneball", *line.split())
    assert (result.exit_code, result.stdout) == (2, "")
    assert remedy in result.stderr


WORDS_OF_A_LINE = "--or --look-ahead two --json 0.5 -0.5 0 1 0.3:0.3 0:0 :"
words = st.sampled_from(WORDS_OF_A_LINE.split()) | st.text(max_size=4)


@given(st.lists(words, max_size=8))
def test_no_words_make_a_traceback(run, line):
    assert run("oneball", *line).exit_code in (0, 2)
