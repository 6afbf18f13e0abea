import pytest

PLAIN = ["odds", "--p", "0.6", "--race", "7:5", "--score", "3:0"]


@pytest.mark.parametrize(
    "words",
    [
        ["odds", "--p", "0.6", "--race", "7 : 5", "--score", "3 : 0"],
        ["odds", "--p", "0.6", "--race", " 7: 5 ", "--score", "3 :0"],
    ],
)
def test_blanks_round_a_colon_mean_nothing(run, words):
    assert run(*words).stdout == run(*PLAIN).stdout != ""


def test_blanks_round_two_dots_mean_nothing(run):
    told = [run("fair", "--p", "0.6", "--games", games).stdout for games in ("7..9", " 7 .. 9")]
    assert told[0] == told[1] != ""


@pytest.mark.parametrize("race", ["7 5", "7 :", ": 5", "7 : : 5"])
def test_a_race_of_which_a_half_is_missing_is_refused(run, race):
    result = run("odds", "--p", "0.6", "--race", race)
    assert (result.exit_code, result.stdout) == (2, "")
    assert "such as 7:5" in result.stderr
