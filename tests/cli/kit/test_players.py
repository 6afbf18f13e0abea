"""Two players, described in one of three ways."""

import click
import pytest

from evenbreak.cli.kit.players import players_of
from evenbreak.games import Rack, loser_breaks, player_2_breaks
from evenbreak.ratings.scale import SCALES


def players(*ratings: str, scale=None, p=None, p1=None, p2=None, breaks=None, first=None):
    return players_of(ratings, scale, p, p1, p2, breaks, first)


def test_by_ratings() -> None:
    found = players("612", "512", scale=SCALES["fargo"])
    assert found.rack == Rack(2 / 3)
    assert players("110", "80").rack == Rack(2 / 3)  # points of the NPL, if no scale is given


def test_by_one_chance() -> None:
    assert players(p=0.6).rack == Rack(0.6)


@pytest.mark.parametrize(
    ("breaks", "first", "breaker"), [("loser", None, 1), ("loser", "b", 2), ("b", None, 2)]
)
def test_by_a_chance_for_each_breaker(breaks: str, first: str | None, breaker: int) -> None:
    found = players(p1=0.6, p2=0.5, breaks=breaks, first=first)
    assert (found.rack, found.first_breaker) == (Rack(0.6, 0.5), breaker)
    assert found.break_format is (loser_breaks if breaks == "loser" else player_2_breaks)


@pytest.mark.parametrize(
    "given",
    [
        {},
        {"p": 0.6, "p1": 0.5, "p2": 0.5, "breaks": "loser"},
        {"p1": 0.6, "p2": 0.5},
        {"p1": 0.6, "breaks": "loser"},
        {"p": 0.6, "breaks": "loser"},
        {"p": 0.6, "first": "b"},
        {"p": 0.6, "scale": SCALES["npl"]},
    ],
)
def test_options_that_contradict_are_refused(given) -> None:
    with pytest.raises(click.UsageError):
        players(**given)


@pytest.mark.parametrize("ratings", [("612",), ("1", "2", "3"), ("1e308", "-1e308")])
def test_two_ratings_of_a_size_to_calculate_with(ratings: tuple[str, ...]) -> None:
    with pytest.raises(click.UsageError):
        players(*ratings)
