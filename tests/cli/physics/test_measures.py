import click
import pytest
from click.testing import CliRunner

from evenbreak.answers.shot_units import IMPERIAL, METRIC
from evenbreak.cli.physics.measures import Measure, measure_option, metric_option


@pytest.fixture(scope="module")
def ask():
    @click.command()
    @measure_option("--length", "LENGTH", 0.1, 1e5, "36", "How long.", required=True)
    @metric_option
    def command(length, units):
        click.echo(f"{length} {units.length.words}")

    return lambda line: CliRunner().invoke(command, line.split())


def test_a_number_in_the_units_that_were_asked_for(ask):
    assert ask("--length 7").output == f"7.0 {IMPERIAL.length.words}\n"
    assert ask("--length 7 --metric").output == f"7.0 {METRIC.length.words}\n"


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("", ["--length", "0.1 to 100,000", "36"]),
        ("--length 0", ["'0'", "0.1 to 100,000"]),
        ("--length nan", ["'nan'", "such as 36"]),
        ("--length 7,5", ["'7,5'", "decimal point: 7.5"]),
    ],
)
def test_a_refusal_says_what_would_do(ask, line, words):
    result = ask(line)
    assert result.exit_code == 2
    assert all(word in " ".join(result.output.split()) for word in words)


def test_a_default_is_taken_as_it_is():
    assert Measure(0.0, 1.0, "0.5").convert(4.0, None, None) == 4.0
