import pytest

from evenbreak.cli.chart.design_options import options_named
from evenbreak.errors import InputError


def message(text, *, in_minutes=False):
    with pytest.raises(InputError) as caught, options_named(in_minutes=in_minutes):
        raise InputError(text)
    return str(caught.value)


def test_parameters_of_the_library_become_options():
    assert message("games_p90 is 3, but too short").startswith("--games-p90 is 3,")
    assert message("games is (7, 9), which is odd").startswith("--games is 7..9,")
    assert message("too many; narrow games, lower rows or up_to") == (
        "too many; narrow --games, lower --rows or --up-to"
    )


def test_a_limit_in_minutes_is_named_as_it_was_given():
    found = message("games_p90 is 3, but too short", in_minutes=True)
    assert found.startswith("--minutes allows 3 games,")


def test_words_that_are_not_parameters_stay():
    assert message("no race lasts that many games") == "no race lasts that many games"


@pytest.mark.parametrize(
    ("line", "named"),
    [
        ("--games 7..9 --mean-games 2", ["--mean-games is 2"]),
        ("--games 7..9 --games-p90 3", ["--games-p90 is 3"]),
        ("--games 7..9 --minutes 24 --minutes-per-game 8", ["--minutes allows 3 games"]),
        ("--games 900..1000", ["narrow --games", "raise --least", "lower --up-to"]),
        (
            "--games 1..99 --rows 60 --spread 98 --up-to 400",
            ["narrow --games", "lower --rows or --up-to"],
        ),
        ("--games 1..2 --least 5:5", ["--games is 1..2"]),
    ],
)
def test_an_impossible_design_names_the_options(run, line, named):
    result = run("chart", "design", *line.split())
    assert (result.exit_code, result.stdout) == (2, "")
    for words in named:
        assert words in " ".join(result.stderr.split())
