"""Options that commands share."""

import click
import pytest
from click.testing import CliRunner

from evenbreak.cli.kit.options import scale_option, seed_option


def shown(command: click.Command, *words: str) -> str:
    result = CliRunner().invoke(command, list(words))
    return result.stdout if result.exit_code == 0 else f"{result.exit_code} {result.stderr}"


def test_a_negative_rating_is_an_argument(run) -> None:
    negative = run("fair", "-20", "1e1", "--race-to", "3", "--scale", "npl", "--json")
    assert negative.exit_code == 0, negative.stderr


@pytest.mark.parametrize("word", ["-x", "--nope", "twenty", "24,5"])
def test_other_words_are_not_ratings(run, word: str) -> None:
    refused = run("fair", "-20", word, "--race-to", "3")
    assert refused.exit_code == 2
    assert word in refused.stderr


@pytest.mark.parametrize(
    ("words", "points"), [((), 30.0), (("--scale", "fargo"), 100.0), (("--scale", "55"), 55.0)]
)
def test_a_scale_by_name_or_points(words: tuple[str, ...], points: float) -> None:
    @click.command()
    @scale_option()
    def command(scale) -> None:
        click.echo(scale.points_per_doubling)

    assert shown(command, *words) == f"{points}\n"
    assert shown(command, "--scale", "yards").startswith("2 ")


def test_a_scale_may_be_left_open() -> None:
    @click.command()
    @scale_option("that of the chart", fixed=False)
    def command(scale) -> None:
        click.echo(repr(scale))

    assert shown(command) == "None\n"
    assert "that of the chart" in " ".join(shown(command, "--help").split())


def test_a_seed() -> None:
    @click.command()
    @seed_option()
    def command(seed: int) -> None:
        click.echo(seed)

    assert shown(command) == "1\n"
    assert shown(command, "--seed", "4294967295") == "4294967295\n"
    assert shown(command, "--seed", "-1").startswith("2 ")
