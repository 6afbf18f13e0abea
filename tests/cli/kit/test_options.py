"""Options that commands share."""

import click
import pytest
from click.testing import CliRunner

from evenbreak.cli.kit.options import (
    PlainCommand,
    race_limit_options,
    refuse_both,
    results_options,
    scale_option,
    seed_option,
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
    @race_limit_options
    def command(games, race_to) -> None:
        refuse_both(games, race_to)
        click.echo(f"{games} {race_to}")

    assert shown(command, "--games", "7..9") == "(7, 9) None\n"
    assert shown(command, "--race-to", "7") == "None 7\n"
    assert shown(command, "--games", "7..9", "--race-to", "7").startswith("2 ")


@click.command()
@results_options
def reading(reading: dict[str, object]) -> None:
    click.echo(f"{reading['columns']} {reading['dates']} {reading['aliases']}")


@pytest.mark.parametrize(
    ("words", "columns"),
    [
        ((), {}),
        (("--columns", "player_a=Home, Player B = Away"), {"player_a": "Home", "player_b": "Away"}),
        (("--columns", "player_a=Name, first,score=S"), {"player_a": "Name, first", "score": "S"}),
        (("--columns", "player_a=x", "--columns", "score=y"), {"player_a": "x", "score": "y"}),
    ],
)
def test_columns_by_their_titles(words: tuple[str, ...], columns: dict[str, str]) -> None:
    assert shown(reading, *words) == f"{columns} None None\n"


@pytest.mark.parametrize("text", ["Home", "=Home", "player_a=", "player_a=x,player_a=y", "a=x,b=X"])
def test_what_names_no_column_is_refused(text: str) -> None:
    assert shown(reading, "--columns", text).startswith("2 ")


def test_the_order_of_dates() -> None:
    assert shown(reading, "--dates", "mdy") == "{} mdy None\n"
    assert shown(reading, "--dates", "ymd").startswith("2 ")
