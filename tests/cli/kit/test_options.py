"""Options that commands share."""

import click
import pytest
from click.testing import CliRunner

from evenbreak.cli.kit.options import (
    PlainCommand,
    refuse_both,
    scale_option,
    seed_option,
    which_races,
)


def shown(command: click.Command, *words: str) -> str:
    result = CliRunner().invoke(command, list(words))
    return result.stdout if result.exit_code == 0 else f"{result.exit_code} {result.stderr}"


@click.command(cls=PlainCommand)
@click.argument("ratings", nargs=-1)
@click.option("--top")
def rated(ratings: tuple[str, ...], top: str | None) -> None:
    click.echo(f"{ratings} {top}")


def test_a_negative_rating_is_an_argument() -> None:
    assert shown(rated, "-20", "--top", "3", "1e2") == "('-20', '1e2') 3\n"


@pytest.mark.parametrize("word", ["-x", "--nope", "twenty", "24,5"])
def test_other_words_are_not_ratings(word: str) -> None:
    assert shown(rated, "-20", word).startswith("2 ")
    assert word in shown(rated, "-20", word)


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


def test_races_by_games_or_by_what_the_stronger_player_needs() -> None:
    @click.command()
    @which_races
    def command(games, race_to) -> None:
        refuse_both(games, race_to)
        click.echo(f"{games} {race_to}")

    assert shown(command, "--games", "7..9") == "(7, 9) None\n"
    assert shown(command, "--race-to", "7") == "None 7\n"
    assert shown(command, "--games", "7..9", "--race-to", "7").startswith("2 ")
