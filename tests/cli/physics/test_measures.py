import pytest
from click.testing import CliRunner

from evenbreak.answers.physics.asked import units_of
from evenbreak.answers.physics.units import IMPERIAL, METRIC
from evenbreak.cli.kit.asked import answered
from evenbreak.questions.physics import TableSpeed


def ask(line):
    return CliRunner().invoke(answered("physics speed"), line.split())


def test_a_number_in_the_units_that_were_asked_for():
    assert units_of(TableSpeed(lag_time=7.0)) is IMPERIAL
    assert units_of(TableSpeed(lag_time=7.0, metric=True)) is METRIC
    assert "--table-length LENGTH" in ask("--help").output


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("", ["--lag-time", "0.1 to 1,000", "7.0"]),
        ("--lag-time 7 --table-length 0", ["'0'", "0.01 to 100,000"]),
        ("--lag-time nan", ["'nan'", "such as 7.0"]),
        ("--lag-time 7,5", ["'7,5'", "decimal point: 7.5"]),
    ],
)
def test_a_refusal_says_what_would_do(line, words):
    result = ask(line)
    assert result.exit_code == 2
    assert all(word in " ".join(result.output.split()) for word in words)
