import click
import pytest
from click.testing import CliRunner

from evenbreak.answers.physics.units import IMPERIAL, METRIC
from evenbreak.cli.physics.measures import Measure, metric_option


@pytest.fixture(scope="module")
def ask():
    @click.command()
    @click.option("--far", type=Measure("length", 0.1, 1e5, "36"), required=True)
    @metric_option
    def command(far, units):
        click.echo(f"{far} {units.length.words}")

    return lambda line: CliRunner().invoke(command, line.split())


def test_a_number_in_the_units_that_were_asked_for(ask):
    assert ask("--far 7").output == f"7.0 {IMPERIAL.length.words}\n"
    assert ask("--far 7 --metric").output == f"7.0 {METRIC.length.words}\n"
    assert "--far LENGTH" in ask("--help").output


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("", ["--far", "0.1 to 100,000", "36"]),
        ("--far 0", ["'0'", "0.1 to 100,000"]),
        ("--far nan", ["'nan'", "such as 36"]),
        ("--far 7,5", ["'7,5'", "decimal point: 7.5"]),
    ],
)
def test_a_refusal_says_what_would_do(ask, line, words):
    result = ask(line)
    assert result.exit_code == 2
    assert all(word in " ".join(result.output.split()) for word in words)


def test_a_default_is_taken_as_it_is():
    assert Measure("share", 0.0, 1.0, "0.5").convert(4.0, None, None) == 4.0
